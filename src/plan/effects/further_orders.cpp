#include <fmt/format.h>

#include "plan/effects/calibrated_bounds.h"
#include "plan/effects/rule.h"
#include "plan/plan.h"
#include "plan/rates.h"

namespace skylapse::plan {

Verdict judge_further_orders(const Plan& plan, const Frame&) {
  const double seconds = rates::further_orders_seconds(plan);
  if (plan.job.sky.orders > 0)
    return {false,
            fmt::format("sky.orders ends them after {}", plan.job.sky.orders),
            {},
            seconds,
            false};
  return {false,
          fmt::format("a geometric tail stands for those that add less than {:g}",
                      rates::stop_below(plan.job.sky.level)),
          kTailError, seconds};
}

}  // namespace skylapse::plan
