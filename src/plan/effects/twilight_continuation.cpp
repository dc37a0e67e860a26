#include <fmt/format.h>

#include "plan/effects/rule.h"
#include "plan/plan.h"

namespace skylapse::plan {

Verdict judge_twilight_continuation(const Plan&, const Frame& frame) {
  if (!frame.sun.extrapolated) return {false, "the sun is above the horizon", 0, 0};
  return {true,
          fmt::format("the model ends at the horizon: shape held, level {:.3g}",
                      frame.sun.twilight_level),
          {},
          0};
}

}  // namespace skylapse::plan
