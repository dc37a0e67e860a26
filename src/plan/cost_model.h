#pragma once
// What a job will cost, before it is run.
#include "plan/plan.h"

namespace skylapse::plan {

struct Cost {
  double core_seconds = 0;  // of one core
  double bytes = 0;         // written
};

/// Estimate for the given frames (numbers from 1). The rates per pixel are those that
/// bench_hosek_wilkie and bench_output print for 1280x720; other machines differ by their speed,
/// pictures by their detail: expect a factor of 2 either way.
Cost estimate_cost(const Plan& plan, const std::vector<long>& frames);

}  // namespace skylapse::plan
