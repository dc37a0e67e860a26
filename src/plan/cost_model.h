#pragma once
// What a job will cost, before it is run.
#include "plan/output_cost.h"
#include "plan/plan.h"

namespace skylapse::plan {

struct Cost {
  double core_seconds = 0;          // of one core; tables that have to be computed included
  double bytes = 0;                 // written
  int table_sets = 0;               // of the atmosphere: one for each air, fewer where air changes
  double table_core_seconds = 0;    // to compute them all
  double table_bytes = 0;           // of memory they take
  std::vector<OutputCost> outputs;  // of the job, in their order; their sky apart
};

/// Estimate for the given frames (numbers from 1). The rates per pixel are those that
/// bench_hosek_wilkie, bench_slice_image and bench_output print, those of tables and slices what
/// the benchmarks of the atmosphere print for software GL; other machines differ by their speed,
/// pictures by their detail: expect a factor of 2 either way.
Cost estimate_cost(const Plan& plan, const std::vector<long>& frames);

}  // namespace skylapse::plan
