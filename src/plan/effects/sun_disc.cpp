#include <fmt/format.h>

#include "plan/effect_planner.h"
#include "plan/effects/rule.h"

namespace skylapse::plan {

Verdict judge_sun_disc(const Plan& plan, const Frame& frame) {
  constexpr double kSeconds = 5e-4;  // bench_sun_disc: 0.3 ms for a small disc, and its energy
  if (!plan.job.sky.sun_disc) return {false, "switched off by sky.sun_disc", {}, kSeconds, false};
  const Angle upper_limb = elevation(frame.sky.sun_apparent) + frame.sky.sun_radius - frame.horizon;
  if (upper_limb <= 0 * deg)
    return {
        false,
        fmt::format("the disc is below the horizon (upper limb at {:.2f} deg)", upper_limb.in(deg)),
        0, kSeconds};
  if (!sun_disc_in_view(plan.sights[frame.camera], frame.sky, frame.horizon))
    return {false, "the sun is outside the picture", 0, kSeconds};
  return {true, "the sun is in the picture", {}, kSeconds};
}

}  // namespace skylapse::plan
