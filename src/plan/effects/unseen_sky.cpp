#include <fmt/format.h>

#include "plan/effects/rule.h"
#include "plan/plan.h"
#include "plan/rates.h"

namespace skylapse::plan {

Verdict judge_unseen_sky(const Plan& plan, const Frame& frame) {
  const ViewReach& view = plan.views[frame.camera];
  return {false,
          fmt::format("the picture reaches from {:.2f} deg to {:.2f} deg", view.lowest.in(deg),
                      view.highest.in(deg)),
          0, rates::slice_seconds(plan) / 2};
}

}  // namespace skylapse::plan
