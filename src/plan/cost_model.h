#pragma once
// What a job will cost, before it is run.
#include "plan/plan.h"

namespace skylapse::plan {

struct Cost {
  double core_seconds = 0;  // of one core
  double bytes = 0;         // written
};

/// Estimate for the given frames (numbers from 1). The rates per pixel were measured by
/// benchmarks/pipeline/bench_frame; other machines differ by their speed, skies by their detail:
/// expect a factor of 2 in time and 1.5 in bytes.
Cost estimate_cost(const Plan& plan, const std::vector<long>& frames);

}  // namespace skylapse::plan
