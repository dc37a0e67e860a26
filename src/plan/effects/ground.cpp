#include <fmt/format.h>

#include "plan/effect_planner.h"
#include "plan/effects/rule.h"
#include "plan/rates.h"

namespace skylapse::plan {

Verdict judge_ground(const Plan& plan, const Frame& frame) {
  const double seconds = is_fitted(plan.model) ? 0 : rates::slice_seconds(plan) / 2;
  const Angle lowest = plan.views[frame.camera].lowest;
  if (lowest >= frame.horizon)
    return {false,
            fmt::format("no pixel looks below the horizon: the lowest {:.2f} deg above it",
                        (lowest - frame.horizon).in(deg)),
            0, seconds};
  return {true, "the picture reaches below the horizon", {}, seconds};
}

}  // namespace skylapse::plan
