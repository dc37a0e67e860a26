// From continuous spectra to the bands that a renderer computes.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "data/cie1931.h"
#include "sky/atmosphere/atmosphere.h"
#include "sky/atmosphere/input_spectra.h"

namespace skylapse::sky::atmosphere {
namespace {

constexpr double kFirstNm = 360, kLastNm = 830;
constexpr int kMaxBands = 64;

// Found by trying: they give the smallest errors over the skies of tests/sky/atmosphere/bands_test.
constexpr double kEdgeFloor = 0.02;   // of the greatest sensitivity, added to it: edges
constexpr double kNeighbours = 0.10;  // share of a bin's light that is interpolated over neighbours
// Added to the sum of the three matching functions in the means. The few bins of a draft are so
// wide that the ends of the spectrum, hardly seen, must not be left out of them.
constexpr double mean_floor(size_t bands) { return bands <= 4 ? 0.12 : bands < 12 ? 0.01 : 0.02; }

/// Matching functions, linear between the nanometres of the table.
glm::dvec3 matching_functions(double wavelength_nm) {
  const double x = std::clamp(wavelength_nm - kFirstNm, 0.0, kLastNm - kFirstNm);
  const size_t i = std::min(static_cast<size_t>(x), data::kCie1931.size() - 2);
  const double f = x - static_cast<double>(i);
  const auto& a = data::kCie1931[i];
  const auto& b = data::kCie1931[i + 1];
  return (1 - f) * glm::dvec3(a[0], a[1], a[2]) + f * glm::dvec3(b[0], b[1], b[2]);
}

double eye(double wavelength_nm) {
  const glm::dvec3 xyz = matching_functions(wavelength_nm);
  return xyz.x + xyz.y + xyz.z;
}

/// Cells of half a nanometre, or less at the ends: the solar spectrum's own resolution.
template <class Visit>
void for_each_cell(double from_nm, double to_nm, const Visit& visit) {
  const int cells = std::max(1, static_cast<int>(std::ceil((to_nm - from_nm) / 0.5)));
  const double width = (to_nm - from_nm) / cells;
  for (int i = 0; i < cells; ++i) visit(from_nm + (i + 0.5) * width, width);
}

struct Bin {
  double from_nm, to_nm;
  double floor;  // of the eye's weight in means
};

/// Means over a bin, weighted by what sun and eye make of each wavelength.
SpectralBand band_of(const Atmosphere& air, const Bin& bin) {
  SpectralBand band;
  double weights = 0;
  for_each_cell(bin.from_nm, bin.to_nm, [&](double x, double width) {
    const Wavelength at = x * nm;
    // Bins without sunlight still have means.
    const double weight = (air.solar_irradiance.at(at) + 1e-30) * (eye(x) + bin.floor) * width;
    const double extinction = air.aerosol_extinction.at(at);
    weights += weight;
    band.wavelength_nm += weight * x;
    band.rayleigh_scattering_per_km += weight * air.rayleigh_scattering.at(at);
    band.aerosol_extinction_per_km += weight * extinction;
    band.aerosol_scattering_per_km +=
        weight * extinction * air.aerosol_single_scattering_albedo.at(at);
    band.ozone_absorption_per_km += weight * air.ozone_absorption.at(at);
    band.ground_albedo += weight * air.ground_albedo.at(at);
  });
  for (double* mean :
       {&band.wavelength_nm, &band.rayleigh_scattering_per_km, &band.aerosol_extinction_per_km,
        &band.aerosol_scattering_per_km, &band.ozone_absorption_per_km, &band.ground_albedo})
    *mean /= weights;
  band.solar_irradiance = air.solar_irradiance.mean(bin.from_nm * nm, bin.to_nm * nm);
  return band;
}

/// Gives the light of the wavelength x, in bin `own`, to the bins' middles on either side of it.
void share_with_neighbours(std::vector<SpectralBand>& bands, size_t own, double x,
                           const glm::dvec3& light) {
  const bool above = x >= bands[own].wavelength_nm;
  if ((own == 0 && !above) || (own + 1 == bands.size() && above)) {
    bands[own].xyz_weight += light;
    return;
  }
  const size_t left = above ? own : own - 1;
  const double a = bands[left].wavelength_nm, b = bands[left + 1].wavelength_nm;
  const double f = (x - a) / (b - a);
  bands[left].xyz_weight += (1 - f) * light;
  bands[left + 1].xyz_weight += f * light;
}

/// What reaches the eye is sunlight times a smooth function q of the wavelength, known once a band.
/// q constant over each bin (the midpoint rule) errs by -q'' width^3 / 24, q linear between the
/// bins' middles (the trapezoidal rule) by twice that with the other sign; a mixture errs by less
/// and keeps all weights positive. Either is exact for q = 1.
void set_xyz_weights(const Atmosphere& air, const std::vector<Wavelength>& edges,
                     std::vector<SpectralBand>& bands) {
  for (size_t i = 0; i < bands.size(); ++i)
    for_each_cell(edges[i].in(nm), edges[i + 1].in(nm), [&](double x, double width) {
      const glm::dvec3 light = air.solar_irradiance.at(x * nm) * width * matching_functions(x);
      bands[i].xyz_weight += (1 - kNeighbours) * light;
      share_with_neighbours(bands, i, x, kNeighbours * light);
    });
  for (SpectralBand& band : bands)
    band.xyz_weight =
        band.solar_irradiance > 0 ? band.xyz_weight / band.solar_irradiance : glm::dvec3(0);
}

Medium without_bands(const Atmosphere& air) {
  Medium medium;
  medium.bottom_radius_km = air.bottom_radius.in(km);
  medium.top_height_km = air.top_height.in(km);
  medium.sun_angular_radius_rad = air.sun_angular_radius.in(rad);
  medium.rayleigh = air.rayleigh;
  medium.aerosol = air.aerosol;
  medium.ozone = air.ozone;
  medium.rayleigh_depolarization = air.rayleigh_depolarization;
  medium.aerosol_g = air.aerosol_g;
  return medium;
}

}  // namespace

std::vector<Wavelength> band_edges(int bands) {
  assert(bands >= 1 && bands <= kMaxBands);
  // Bins of equal shares of the root of the sensitivity: where sun and eye count four times as
  // much, bins are half as wide.
  const Spectrum sun = solar_irradiance_spectrum();
  std::vector<double> upper_nm, share;
  for_each_cell(kFirstNm, kLastNm, [&](double x, double width) {
    upper_nm.push_back(x + width / 2);
    share.push_back(sun.at(x * nm) * eye(x));
  });
  const double greatest = *std::max_element(share.begin(), share.end());
  double sum = 0;
  for (double& s : share) s = sum += std::sqrt(s / greatest + kEdgeFloor);

  std::vector<Wavelength> edges{kFirstNm * nm};
  for (int i = 1; i < bands; ++i) {
    const double wanted = sum * i / bands;
    const size_t cell =
        static_cast<size_t>(std::lower_bound(share.begin(), share.end(), wanted) - share.begin());
    const double before = cell == 0 ? 0 : share[cell - 1];
    const double from_nm = cell == 0 ? kFirstNm : upper_nm[cell - 1];
    const double f = (wanted - before) / (share[cell] - before);
    edges.push_back((from_nm + f * (upper_nm[cell] - from_nm)) * nm);
  }
  edges.push_back(kLastNm * nm);
  return edges;
}

Medium medium_at(const Atmosphere& atmosphere, const std::vector<Wavelength>& edges) {
  assert(edges.size() >= 2);
  const double floor = mean_floor(edges.size() - 1);
  Medium medium = without_bands(atmosphere);
  for (size_t i = 0; i + 1 < edges.size(); ++i)
    medium.bands.push_back(band_of(atmosphere, {edges[i].in(nm), edges[i + 1].in(nm), floor}));
  set_xyz_weights(atmosphere, edges, medium.bands);
  return medium;
}

Medium medium_sampled(const Atmosphere& atmosphere, const std::vector<Wavelength>& wavelengths) {
  Medium medium = without_bands(atmosphere);
  for (const Wavelength at : wavelengths) {
    const double extinction = atmosphere.aerosol_extinction.at(at);
    medium.bands.push_back({.wavelength_nm = at.in(nm),
                            .solar_irradiance = atmosphere.solar_irradiance.at(at),
                            .rayleigh_scattering_per_km = atmosphere.rayleigh_scattering.at(at),
                            .aerosol_scattering_per_km =
                                extinction * atmosphere.aerosol_single_scattering_albedo.at(at),
                            .aerosol_extinction_per_km = extinction,
                            .ozone_absorption_per_km = atmosphere.ozone_absorption.at(at),
                            .ground_albedo = atmosphere.ground_albedo.at(at)});
  }
  return medium;
}

}  // namespace skylapse::sky::atmosphere
