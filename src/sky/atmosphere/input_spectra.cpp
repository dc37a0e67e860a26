#include "sky/atmosphere/input_spectra.h"

#include <cmath>

#include "data/ground_albedo.h"
#include "data/ozone.h"
#include "data/rayleigh.h"
#include "data/solar_spectrum.h"
#include "sky/ground_albedo.h"

namespace skylapse::sky::atmosphere {
namespace {

constexpr double kMoleculesPerM2OfDobsonUnit = 2.6867e20;

Spectrum column_of(const auto& axis, const auto& table, size_t column) {
  Spectrum spectrum;
  spectrum.wavelength_nm.assign(axis.begin(), axis.end());
  for (const auto& row : table) spectrum.value.push_back(row[column]);
  return spectrum;
}

/// Nodes every nanometre, the logarithm linear in `scale` of the wavelength between given nodes.
/// For spectra that fall by powers and exponentials the straight line between nodes 5 nm apart is
/// wrong by up to 0.1 %.
Spectrum refined(const Spectrum& coarse, auto scale) {
  Spectrum fine;
  for (size_t i = 0; i + 1 < coarse.value.size(); ++i) {
    const double from = coarse.wavelength_nm[i], to = coarse.wavelength_nm[i + 1];
    const double ratio = std::log(coarse.value[i + 1] / coarse.value[i]);
    for (double x = from; x < to; x += 1) {
      const double f = (scale(x) - scale(from)) / (scale(to) - scale(from));
      fine.wavelength_nm.push_back(x);
      fine.value.push_back(coarse.value[i] * std::exp(f * ratio));
    }
  }
  fine.wavelength_nm.push_back(coarse.wavelength_nm.back());
  fine.value.push_back(coarse.value.back());
  return fine;
}

}  // namespace

Spectrum solar_irradiance_spectrum() {
  return column_of(data::kSolarSpectrumWavelengthNm, data::kSolarSpectrum, 0);
}

Spectrum rayleigh_optical_depth_spectrum() {
  constexpr size_t kOpticalDepth = 2;
  static_assert(data::kRayleighColumns[kOpticalDepth] == "optical_depth");
  return refined(column_of(data::kRayleighWavelengthNm, data::kRayleigh, kOpticalDepth),
                 [](double nm) { return std::log(nm); });
}

double rayleigh_depolarization() {
  constexpr size_t kDepolarization = 1;
  static_assert(data::kRayleighColumns[kDepolarization] == "depolarization");
  return column_of(data::kRayleighWavelengthNm, data::kRayleigh, kDepolarization).at(550.0 * nm);
}

Spectrum ozone_optical_depth_spectrum() {
  Spectrum depth =
      refined(column_of(data::kOzoneWavelengthNm, data::kOzone, 0), [](double nm) { return nm; });
  for (double& value : depth.value) value *= kMoleculesPerM2OfDobsonUnit;
  return depth;
}

std::optional<Spectrum> ground_albedo_spectrum(std::string_view name) {
  const auto& columns = data::kGroundAlbedoColumns;
  for (size_t column = 0; column < columns.size(); ++column)
    if (columns[column] == name)
      return column_of(data::kGroundAlbedoWavelengthNm, data::kGroundAlbedo, column);
  if (const auto grey = albedo_bands(name)) return constant_spectrum(grey->mean);
  return std::nullopt;
}

}  // namespace skylapse::sky::atmosphere
