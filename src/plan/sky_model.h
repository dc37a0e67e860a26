#pragma once
// Which model renders a job, and what that means for its cameras.
#include <string>
#include <vector>

#include "astro/sky_state.h"
#include "config/job_config.h"
#include "plan/frame_schedule.h"

namespace skylapse::plan {

/// The word of sky.model; "auto" before the choice.
std::string name_of(config::SkyModel model);

using config::is_fitted;

/// Cameras up to this height count as on the ground for the choice of a model. The Hosek-Wilkie sky
/// was computed for an observer at sea level; at 1 km 11 % of the air lies below the camera, its
/// sky is darker by about as much, which is the fit's own error against its reference.
inline constexpr Length kNearGround = 1.0 * km;

struct ModelChoice {
  config::SkyModel model = config::SkyModel::hosek_wilkie;  // never `automatic`
  std::string reason;
};

/// One model for all frames of a job, so that no sequence jumps from one to another. What sky.model
/// names; for `auto` Hosek-Wilkie where it is at home: every site below kNearGround, haze of
/// turbidity 1..10, nothing in the config that needs an atmosphere, the sun's apparent centre at or
/// above the horizon in every frame; else Bruneton. `suns` are the states of schedule.times. The
/// reason names the first frame, site or key that decided.
ModelChoice choose_model(const config::JobConfig& job, const Schedule& schedule,
                         const std::vector<astro::SkyState>& suns);

/// Height of a camera above the ground of a computed atmosphere, which stands for sea level: the
/// site's height above the ellipsoid, at least 0. The geoid, up to 106 m off the ellipsoid, is not
/// told apart: that much air is a tenth of what Hosek-Wilkie is forgiven.
Length camera_height(const config::Site& site);

/// Elevation of the horizon of a camera at `height` over a planet of that radius: 0 on the ground,
/// minus the dip above it.
Angle horizon_elevation(Length height, Length planet_radius);

/// Refraction at a site. air.pressure is that at the observer; where the config does not give it, a
/// camera above kNearGround in a computed atmosphere has what its height leaves of the pressure of
/// sea level: exp(-height / 8.4 km).
astro::RefractionConditions refraction_at(const config::JobConfig& job, const config::Site& site,
                                          config::SkyModel model);

}  // namespace skylapse::plan
