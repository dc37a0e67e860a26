#include "astro/refraction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plan/effect_planner.h"
#include "plan/effects/light_bounds.h"
#include "plan/effects/rule.h"

namespace skylapse::plan {
namespace {

/// d ln / d angle, greatest: of the light of a sun that moves by a small angle. The aerosol's phase
/// function changes by at most 3 g / (1 - g^2) a radian, (1 + nu^2) by at most 1; sunlight on level
/// ground by cot e; its way through the air by depth times the change of the air mass.
double slope_of_light(const Plan& plan, const Frame& frame, Angle sun) {
  const double s = std::max(sin(sun), 1e-3);
  const auto air = air_of_frame(plan.job, plan.air, frame);
  const AirDepths depths = depths_of(air);
  double depth = 0;
  for (int i = 0; i < AirDepths::kCount; ++i)
    depth = std::max(depth, depths.rayleigh[i] + depths.aerosol[i] + depths.ozone[i]);
  const double g = std::min(std::abs(air.aerosol_g), 0.99);
  // Of paths to points far off, whose sun stands lower by a few degrees, twice is enough above 20
  // degrees; below nothing is claimed.
  return 3 * g / (1 - g * g) + 1 + 1 / s + 2 * depth / (s * s);
}

}  // namespace

Verdict judge_refraction(const Plan& plan, const Frame& frame) {
  constexpr double kSeconds = 1e-6;
  constexpr Angle kLowSun = 20.0 * deg;
  const auto conditions = refraction_at(plan.job, plan.job.sites[frame.site], plan.model);
  if (!plan.job.air.refraction.enabled)
    return {false, "switched off by air.refraction", {}, kSeconds, false};
  const Angle at = elevation(frame.sky.sun_true);
  const Angle lift = astro::refraction(at, conditions);
  if (lift == Angle{}) return {false, "it lifts the sun by 0 arcmin", 0, kSeconds};
  const std::string reason = fmt::format("lifts the sun by {:.2f} arcmin", lift.in(arcmin));
  const Angle reach = frame.sky.sun_radius + lift;
  const bool disc =
      plan.job.sky.sun_disc && plan.sights[frame.camera].sees_disc(frame.sky.sun_true, reach, 4);
  if (disc || at < kLowSun) return {true, reason, {}, kSeconds};
  const double bound = lift.in(rad)*slope_of_light(plan, frame, at);
  return {bound > kLeaveBelow, reason, bound, kSeconds};
}

}  // namespace skylapse::plan
