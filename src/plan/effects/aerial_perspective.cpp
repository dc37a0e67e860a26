#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plan/effects/light_bounds.h"
#include "plan/effects/rule.h"
#include "plan/plan.h"

namespace skylapse::plan {

/// Length of the way to the ground along the highest ray that reaches it, over which the air takes
/// from the ground's light its depth, and adds at most the sun's light scattered forward.
Verdict judge_aerial_perspective(const Plan& plan, const Frame& frame) {
  constexpr double kSeconds = 0;  // the rays to the ground are part of `ground`
  const ViewReach& view = plan.views[frame.camera];
  if (view.lowest >= frame.horizon) return {false, "no ground is seen", 0, kSeconds};
  if (frame.camera_height == Length{})
    return {false, "the camera is 0 m above the ground", 0, kSeconds};
  const auto& air = plan.job.air.description;
  const double R = air.planet_radius.in(km), h = frame.camera_height.in(km);
  const Angle highest = std::min(view.highest, frame.horizon);
  // r^2 = R^2: s = r sin e' - sqrt(R^2 - r^2 cos^2 e'), e' the depression.
  const double sine = -sin(highest), r = R + h;
  const double under = std::max(0.0, R * R - r * r * (1 - sine * sine));
  const double way = h * (2 * R + h) / (r * sine + std::sqrt(under));
  // Nowhere is the air denser than if the whole column were one scale height thick at the ground.
  const auto& depths = plan.reach.most;
  double per_km = 0, scattering_per_km = 0;
  for (int i = 0; i < AirDepths::kCount; ++i) {
    const double aerosol_km = air.stratospheric_optical_depth > 0
                                  ? std::min(1.0, air.aerosol_scale_height.in(km))
                                  : air.aerosol_scale_height.in(km);
    per_km = std::max(per_km, depths.rayleigh[i] / 8 + depths.aerosol[i] / aerosol_km);
    scattering_per_km = std::max(
        scattering_per_km, depths.rayleigh[i] / 8 + depths.aerosol_scattering[i] / aerosol_km);
  }
  const double g = std::min(std::abs(air.aerosol_g), 0.99);
  const double peak = (1 - g * g) / (2 + g * g) * 3 / std::pow(1 - g, 3) / (4 * std::numbers::pi);
  const double added = scattering_per_km * way * kSolarY * std::max(1.0, peak);
  const double bound = per_km * way + added / darkest_step(frame);
  return {bound > kLeaveBelow, fmt::format("up to {:.3g} km of air before the ground", way), bound,
          kSeconds};
}

}  // namespace skylapse::plan
