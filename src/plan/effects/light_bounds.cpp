#include "plan/effects/light_bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "color/exposure.h"
#include "core/constants.h"
#include "plan/plan.h"
#include "sky/atmosphere/input_spectra.h"

namespace skylapse::plan {
namespace {

constexpr double kDarkestValue = 1 / (255 * 12.92);
constexpr double kStandardPressureHpa = 1013.25, kReferenceNm = 550;

/// Least slant column over the vertical one towards elevation `e`, for air that lies below `top`:
/// each layer is crossed at (R + h) / sqrt((R + h)^2 - R^2 cos^2 e), which is least at the top.
double least_air_mass(Angle e, Length planet_radius, Length top) {
  const double R = planet_radius.in(km), r = R + top.in(km), x = R * cos(e);
  return r / std::sqrt(r * r - x * x);
}

}  // namespace

double darkest_step(const Frame& frame) {
  return kDarkestValue / (color::exposure_scale_per_cd_m2(frame.ev) * kLuminousEfficacy);
}

double AirDepths::greatest_scattering() const {
  double most = 0;
  for (int i = 0; i < kCount; ++i) most = std::max(most, rayleigh[i] + aerosol_scattering[i]);
  return most;
}

double AirDepths::least_extinction() const {
  double least = rayleigh[0] + aerosol[0] + ozone[0];
  for (int i = 1; i < kCount; ++i) least = std::min(least, rayleigh[i] + aerosol[i] + ozone[i]);
  return least;
}

AirDepths depths_of(const sky::atmosphere::AirDescription& air) {
  static const auto kRayleigh = sky::atmosphere::rayleigh_optical_depth_spectrum();
  static const auto kOzone = sky::atmosphere::ozone_optical_depth_spectrum();
  AirDepths depths;
  for (int i = 0; i < AirDepths::kCount; ++i) {
    const Wavelength at = kDepthWavelengths[i] * nm;
    depths.rayleigh[i] = kRayleigh.at(at) * air.surface_pressure.in(hPa) / kStandardPressureHpa;
    depths.aerosol[i] = (air.aerosol_optical_depth + air.stratospheric_optical_depth) *
                        std::pow(kDepthWavelengths[i] / kReferenceNm, -air.angstrom_exponent);
    depths.aerosol_scattering[i] = depths.aerosol[i] * air.aerosol_single_scattering_albedo;
    depths.ozone[i] = kOzone.at(at) * air.ozone_du;
  }
  return depths;
}

double longest_line_exponential(Length planet_radius, Length scale_height) {
  return std::sqrt(2 * std::numbers::pi * (planet_radius / scale_height));
}

double longest_line_tent(Length planet_radius, Length bottom, Length top) {
  const double R = planet_radius.in(km), b = bottom.in(km), t = top.in(km);
  return 2 * std::sqrt((t - b) * (2 * R + t + b)) / ((t - b) / 2);
}

double disc_light_bound(const Plan& plan, const Frame& frame) {
  double transmittance = 1;
  if (!is_fitted(plan.model) && frame.camera_height == Length{}) {
    const auto air = air_of_frame(plan.job, plan.air, frame);
    const Angle highest = elevation(frame.sun.direction) + frame.sky.sun_radius;
    transmittance = std::exp(-depths_of(air).least_extinction() *
                             least_air_mass(highest, air.planet_radius, air.top_height));
  }
  return kSolarY * frame.sun.distance_factor * transmittance;
}

double disc_change_bound(const Plan& plan, const Frame& frame, double share) {
  const PixelSides& sides = plan.pixels[frame.camera];
  const double pixel = sides.smallest.in(rad)*sides.smallest.in(rad);
  // No pixel holds more than the disc's own radiance.
  const double disc = std::numbers::pi * sin(frame.sky.sun_radius) * sin(frame.sky.sun_radius);
  const double most = std::min(share, pixel / disc);
  return most * disc_light_bound(plan, frame) / pixel / darkest_step(frame);
}

}  // namespace skylapse::plan
