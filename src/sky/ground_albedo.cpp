#include "sky/ground_albedo.h"

#include <algorithm>
#include <cmath>

#include "data/ground_albedo.h"

namespace skylapse::sky {
namespace {

struct GreyGround {
  std::string_view name;
  double value;
};

/// Broadband albedo of grounds without a measured spectrum, as in pvlib's table (BSD-3).
constexpr std::array kGreyGrounds{
    GreyGround{"asphalt", 0.12},    GreyGround{"concrete", 0.30}, GreyGround{"fresh-grass", 0.26},
    GreyGround{"fresh-snow", 0.75}, GreyGround{"old-snow", 0.65}, GreyGround{"sand", 0.40},
    GreyGround{"sea", 0.06},        GreyGround{"soil", 0.17},     GreyGround{"urban", 0.18},
};

/// Mean of a measured spectrum between two wavelengths, held constant beyond its ends.
double mean_between(size_t column, double from_nm, double to_nm) {
  const auto& axis = data::kGroundAlbedoWavelengthNm;
  constexpr double kStep = 1.0;  // nm; the spectra are linear between points 10 nm apart
  double sum = 0;
  int count = 0;
  for (double nm = from_nm + kStep / 2; nm < to_nm; nm += kStep, ++count) {
    const double x = std::clamp((nm - axis.front()) / (axis[1] - axis[0]), 0.0, axis.size() - 1.0);
    const size_t i = std::min(static_cast<size_t>(x), axis.size() - 2);
    const double f = x - static_cast<double>(i);
    sum += (1 - f) * data::kGroundAlbedo[i][column] + f * data::kGroundAlbedo[i + 1][column];
  }
  return sum / count;
}

AlbedoSpectrum measured_bands(size_t column) {
  AlbedoSpectrum albedo;
  for (int band = 0; band < kBandCount; ++band) {
    const double centre = band_wavelength_nm(band);
    albedo.bands[band] = mean_between(column, centre - 20, centre + 20);
  }
  albedo.mean = mean_between(column, 400, 700);
  return albedo;
}

}  // namespace

AlbedoSpectrum grey_bands(double value) {
  AlbedoSpectrum albedo;
  albedo.bands.fill(value);
  albedo.mean = value;
  return albedo;
}

std::optional<AlbedoSpectrum> albedo_bands(std::string_view name) {
  for (const GreyGround& ground : kGreyGrounds)
    if (ground.name == name) return grey_bands(ground.value);
  const auto& columns = data::kGroundAlbedoColumns;
  for (size_t column = 0; column < columns.size(); ++column)
    if (columns[column] == name) return measured_bands(column);
  return std::nullopt;
}

const std::vector<std::string>& ground_albedo_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all(data::kGroundAlbedoColumns.begin(),
                                 data::kGroundAlbedoColumns.end());
    for (const GreyGround& ground : kGreyGrounds) all.emplace_back(ground.name);
    std::sort(all.begin(), all.end());
    return all;
  }();
  return names;
}

}  // namespace skylapse::sky
