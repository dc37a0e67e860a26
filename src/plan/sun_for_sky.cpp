#include "plan/sun_for_sky.h"

#include <algorithm>

#include "astro/refraction.h"
#include "sky/twilight.h"

namespace skylapse::plan {
namespace {

/// Irradiance over that at 1 au.
double distance_factor(const astro::SkyState& sky) {
  const double au = 1 * astronomical_unit / sky.sun_distance;
  return au * au;
}

}  // namespace

Angle true_elevation_of_apparent_horizon(const astro::RefractionConditions& refraction) {
  if (!refraction.enabled) return 0 * deg;
  double low = -1, high = 0;  // apparent elevation is negative at -1 deg and positive at 0
  while (low + astro::refraction(low * deg, refraction).in(deg) > 0) low -= 1;  // dense cold air
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (middle + astro::refraction(middle * deg, refraction).in(deg) < 0 ? low : high) = middle;
  }
  return high * deg;
}

SunForSky sun_for_sky(const astro::SkyState& sky, const astro::RefractionConditions& refraction,
                      Illuminance sky_at_horizon) {
  SunForSky sun;
  const Angle apparent = elevation(sky.sun_apparent);
  sun.extrapolated = apparent < 0 * deg;
  sun.elevation = std::clamp(apparent, 0 * deg, 90 * deg);
  sun.direction =
      sun.extrapolated ? enu_direction(azimuth(sky.sun_apparent), 0 * deg) : sky.sun_apparent;
  if (sun.extrapolated)
    sun.twilight_level = sky::twilight_level(
        elevation(sky.sun_true), true_elevation_of_apparent_horizon(refraction), sky_at_horizon);
  sun.distance_factor = distance_factor(sky);
  return sun;
}

SunForSky sun_for_atmosphere(const astro::SkyState& sky) {
  SunForSky sun;
  sun.direction = sky.sun_apparent;
  sun.elevation = elevation(sky.sun_apparent);
  sun.distance_factor = distance_factor(sky);
  return sun;
}

}  // namespace skylapse::plan
