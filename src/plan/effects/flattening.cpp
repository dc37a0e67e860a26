#include <fmt/format.h>

#include "plan/effects/light_bounds.h"
#include "plan/effects/rule.h"
#include "plan/plan.h"

namespace skylapse::plan {

/// A disc flattened to the share k of its height loses 1 - k of its light, and no more than that
/// lies elsewhere in it.
Verdict judge_flattening(const Plan& plan, const Frame& frame) {
  constexpr double kSeconds = 2e-5;
  if (frame.sun_flattening == 1) return {false, "the air lifts the disc as a whole", 0, kSeconds};
  if (!judge_sun_disc(plan, frame).called_for) return {false, "no disc is drawn", 0, kSeconds};
  const double lost = 1 - frame.sun_flattening;
  const double bound = disc_change_bound(plan, frame, 2 * lost);
  return {bound > kLeaveBelow,
          fmt::format("the disc is {:.4f} of its width high", frame.sun_flattening), bound,
          kSeconds};
}

}  // namespace skylapse::plan
