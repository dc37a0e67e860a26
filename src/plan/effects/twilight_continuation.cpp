#include <fmt/format.h>

#include "plan/effects/rule.h"
#include "plan/plan.h"

namespace skylapse::plan {

Verdict judge_twilight_continuation(const Plan&, const Frame& frame) {
  if (!frame.sun.extrapolated) return {false, "the sun is above the horizon", 0, 0};
  return {
      true,
      fmt::format("the model ends at the horizon: its shape is held, the sun being at {:.2f} deg",
                  elevation(frame.sky.sun_apparent).in(deg)),
      {},
      0};
}

}  // namespace skylapse::plan
