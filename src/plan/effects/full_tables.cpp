#include <fmt/format.h>

#include "plan/effects/calibrated_bounds.h"
#include "plan/effects/rule.h"
#include "plan/plan.h"
#include "plan/rates.h"

namespace skylapse::plan {

Verdict judge_full_tables(const Plan& plan, const Frame&) {
  return {false,
          fmt::format("suns from {:.2f} deg up to {:.2f} deg are read",
                      plan.reach.lowest_sun.in(deg), plan.reach.highest_sun.in(deg)),
          kPartialTablesError, rates::full_tables_seconds(plan)};
}

}  // namespace skylapse::plan
