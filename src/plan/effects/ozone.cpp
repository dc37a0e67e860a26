#include <fmt/format.h>

#include <algorithm>

#include "plan/effects/light_bounds.h"
#include "plan/effects/rule.h"
#include "plan/plan.h"

namespace skylapse::plan {

/// No path of light through the layer is longer than its longest chord; light that reaches the
/// camera crosses it on its way in and on its way out, and once more for what scatters it between.
Verdict judge_ozone(const Plan& plan, const Frame&) {
  constexpr double kCrossings = 3;
  constexpr double kSeconds = 0;  // a third of the optical depths, which is not felt
  const auto& depths = plan.reach.most;
  const double depth = *std::max_element(depths.ozone.begin(), depths.ozone.end());
  const double line = longest_line_tent(plan.job.air.description.planet_radius, 10 * km, 40 * km);
  const double bound = depth * line * kCrossings;
  return {bound > kLeaveBelow, fmt::format("the depth of its longest line is {:.3g}", depth * line),
          bound, kSeconds};
}

}  // namespace skylapse::plan
