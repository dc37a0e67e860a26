#include "sky/atmosphere/atmosphere.h"

#include <fmt/format.h>

#include <cmath>

#include "sky/atmosphere/input_spectra.h"
#include "sky/atmosphere/standard_air.h"

namespace skylapse::sky::atmosphere {
namespace {

constexpr double kStandardPressureHpa = 1013.25;
constexpr double kReferenceNm = 550;
constexpr Length kOzoneBottom = 10.0 * km, kOzonePeak = 25.0 * km, kOzoneTop = 40.0 * km;

/// A value of a description and the range that it must lie in; NaN lies in none.
struct Limit {
  std::string_view name;
  double value, low, high;
  std::string_view unit;
};

Status check_range(const Limit& limit) {
  if (limit.value >= limit.low && limit.value <= limit.high) return Done{};
  return Error{
      ErrorCode::invalid_input,
      fmt::format("{} of {:g}{} is no property of an atmosphere", limit.name, limit.value,
                  limit.unit),
      {},
      fmt::format("allowed: {:g}{} to {:g}{}", limit.low, limit.unit, limit.high, limit.unit)};
}

Status check_order(std::string_view lower_name, Length lower, std::string_view upper_name,
                   Length upper) {
  if (lower <= upper) return Done{};
  return Error{ErrorCode::invalid_input,
               fmt::format("{} of {:g} km is above {} of {:g} km", lower_name, lower.in(km),
                           upper_name, upper.in(km)),
               {},
               fmt::format("raise {}, or lower {}", upper_name, lower_name)};
}

Status check(const AirDescription& air) {
  const Limit limits[] = {
      {"aerosol optical depth", air.aerosol_optical_depth, 0, kMaxAerosolOpticalDepth, ""},
      {"Angstrom exponent", air.angstrom_exponent, -1, 4, ""},
      {"aerosol single scattering albedo", air.aerosol_single_scattering_albedo, 0, 1, ""},
      {"aerosol g", air.aerosol_g, -0.99, 0.99, ""},
      {"aerosol scale height", air.aerosol_scale_height.in(km), 0.01, 100, " km"},
      {"stratospheric optical depth", air.stratospheric_optical_depth, 0, 10, ""},
      {"bottom of the stratospheric layer", air.stratospheric_bottom.in(km), 0, 1000, " km"},
      {"ozone column", air.ozone_du, 0, 5000, " DU"},
      {"surface pressure", air.surface_pressure.in(hPa), 0, 100'000, " hPa"},
      {"planet radius", air.planet_radius.in(km), 1, 1e6, " km"},
      {"top of the atmosphere", air.top_height.in(km), 1, 1000, " km"},
  };
  for (const Limit& limit : limits)
    if (const Status status = check_range(limit); !status) return status;
  for (const double value : air.ground_albedo.value)
    if (const Status status = check_range({"ground albedo", value, 0, 1, ""}); !status)
      return status;
  if (air.ozone_du > 0)
    if (const Status status = check_order("the top of the ozone layer", kOzoneTop,
                                          "the top of the atmosphere", air.top_height);
        !status)
      return status;
  if (!(air.stratospheric_optical_depth > 0)) return Done{};
  if (!(air.stratospheric_bottom < air.stratospheric_top))
    return Error{ErrorCode::invalid_input,
                 fmt::format("the stratospheric layer ends at {:g} km, not above its bottom at "
                             "{:g} km",
                             air.stratospheric_top.in(km), air.stratospheric_bottom.in(km)),
                 {},
                 "a layer such as 15 km to 25 km"};
  return check_order("the top of the stratospheric layer", air.stratospheric_top,
                     "the top of the atmosphere", air.top_height);
}

Spectrum scaled(Spectrum spectrum, double factor) {
  for (double& value : spectrum.value) value *= factor;
  return spectrum;
}

/// Extinction that falls with a power of the wavelength, at nodes that keep it to 0.01 %.
Spectrum angstrom_spectrum(double at_550_nm, double exponent) {
  Spectrum spectrum;
  for (double x = 280; x <= 1000; x += 5) {
    spectrum.wavelength_nm.push_back(x);
    spectrum.value.push_back(at_550_nm * std::pow(x / kReferenceNm, -exponent));
  }
  return spectrum;
}

/// The density is 1 at the ground, or at the peak of the stratospheric layer if there is nothing
/// else: there the coefficients are quoted.
void set_aerosol(const AirDescription& air, Atmosphere& atmosphere) {
  const double top_km = air.top_height.in(km);
  double per_km = 0;
  if (air.aerosol_optical_depth > 0) {
    atmosphere.aerosol = exponential_profile(air.aerosol_scale_height, air.top_height);
    per_km = air.aerosol_optical_depth / atmosphere.aerosol.vertical_column_km(top_km);
  }
  if (air.stratospheric_optical_depth > 0) {
    const DensityProfile layer =
        tent_profile(air.stratospheric_bottom,
                     (air.stratospheric_bottom + air.stratospheric_top) / 2, air.stratospheric_top);
    const double peak_per_km = air.stratospheric_optical_depth / layer.vertical_column_km(top_km);
    if (per_km == 0) per_km = peak_per_km;
    for (DensityTerm term : layer.terms) {
      term.slope_per_km *= peak_per_km / per_km;
      term.constant *= peak_per_km / per_km;
      atmosphere.aerosol.terms.push_back(term);
    }
  }
  atmosphere.aerosol_extinction = angstrom_spectrum(per_km, air.angstrom_exponent);
  atmosphere.aerosol_single_scattering_albedo =
      constant_spectrum(air.aerosol_single_scattering_albedo);
  atmosphere.aerosol_g = air.aerosol_g;
}

}  // namespace

Result<Atmosphere> atmosphere_of(const AirDescription& air) {
  if (const Status status = check(air); !status) return status.error();
  const double top_km = air.top_height.in(km);
  Atmosphere atmosphere;
  atmosphere.bottom_radius = air.planet_radius;
  atmosphere.top_height = air.top_height;
  atmosphere.solar_irradiance = solar_irradiance_spectrum();
  atmosphere.rayleigh = standard_air_profile(air.top_height);
  atmosphere.rayleigh_scattering = scaled(rayleigh_optical_depth_spectrum(),
                                          air.surface_pressure.in(hPa) / kStandardPressureHpa /
                                              atmosphere.rayleigh.vertical_column_km(top_km));
  atmosphere.rayleigh_depolarization = rayleigh_depolarization();
  set_aerosol(air, atmosphere);
  if (air.ozone_du > 0) {
    atmosphere.ozone = tent_profile(kOzoneBottom, kOzonePeak, kOzoneTop);
    atmosphere.ozone_absorption = scaled(
        ozone_optical_depth_spectrum(), air.ozone_du / atmosphere.ozone.vertical_column_km(top_km));
  }
  atmosphere.ground_albedo =
      air.ground_albedo.value.empty() ? constant_spectrum(0.2) : air.ground_albedo;
  return atmosphere;
}

}  // namespace skylapse::sky::atmosphere
