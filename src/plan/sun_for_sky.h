#pragma once
#include "astro/sky_state.h"
#include "core/frames.h"

namespace skylapse::plan {

/// How the Hosek-Wilkie sky, which ends at sun elevation 0, is asked for a sun anywhere.
struct SunForSky {
  Direction<Enu> direction;    // apparent sun; on the horizon below it when the sun has set
  Angle elevation;             // of `direction`, 0..90 deg
  double twilight_level = 1;   // factor on the sky's radiance: 1 while the sun is up
  double distance_factor = 1;  // (1 au / distance)^2, on sky and sun alike
  bool extrapolated = false;   // the sun's apparent centre is below the horizon
};

/// True elevation at which the sun's centre appears on the horizon (0 without refraction).
Angle true_elevation_of_apparent_horizon(const astro::RefractionConditions& refraction);

/// `sky_at_horizon` is the model's own illuminance, sky alone, at sun elevation 0.
SunForSky sun_for_sky(const astro::SkyState& sky, const astro::RefractionConditions& refraction,
                      Illuminance sky_at_horizon);

}  // namespace skylapse::plan
