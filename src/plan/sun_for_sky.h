#pragma once
#include "astro/sky_state.h"
#include "core/frames.h"

namespace skylapse::plan {

/// The sun as a sky model is asked for it.
struct SunForSky {
  Direction<Enu> direction;    // Hosek-Wilkie: the apparent sun, on the horizon when it has set
  Angle elevation;             // of `direction`
  double twilight_level = 1;   // factor on the sky's radiance: 1 while the sun is up
  double distance_factor = 1;  // (1 au / distance)^2, on sky and sun alike
  bool extrapolated = false;   // the sun is where the model does not reach
};

/// True elevation at which the sun's centre appears on the horizon (0 without refraction).
Angle true_elevation_of_apparent_horizon(const astro::RefractionConditions& refraction);

/// How the Hosek-Wilkie sky, which ends at sun elevation 0, is asked for a sun anywhere:
/// `direction` is at 0..90 deg. `sky_at_horizon` is the model's own illuminance, sky alone, at sun
/// elevation 0.
SunForSky sun_for_sky(const astro::SkyState& sky, const astro::RefractionConditions& refraction,
                      Illuminance sky_at_horizon);

/// How a computed atmosphere, whose rays are straight, is asked for: the sun that scatters stands
/// where it is seen. Below the horizon it stands as much higher as astro::refraction says, which
/// fades out until -6 deg, so that nothing jumps; the disc is drawn at the same place.
SunForSky sun_for_atmosphere(const astro::SkyState& sky);

}  // namespace skylapse::plan
