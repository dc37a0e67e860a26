#include "plan/rates.h"

#include <algorithm>

#include "plan/plan.h"

namespace skylapse::plan::rates {
namespace {

constexpr double kSliceGroupSeconds = 0.015;  // of four wavelengths, 64 x 128 directions
// Of a slice without multiple scattering, and of tables with more orders or all suns, over one
// with or as usual (bench_effects).
constexpr double kMultipleShareOfSlice = 0.4, kFurtherOrders = 0.8;

double groups(const Plan& plan) { return (plan.job.sky.wavelengths + 3) / 4; }
double per_frame(const Plan& plan) { return 1.0 / double(std::max<size_t>(1, plan.frames.size())); }

/// Core seconds to compute the tables of four wavelengths on software GL, shaders compiled.
double table_group_seconds(sky::bruneton::Level level) {
  switch (level) {
    case sky::bruneton::Level::draft:
      return 0.1;
    case sky::bruneton::Level::low:
      return 0.3;
    case sky::bruneton::Level::standard:
      return 0.55;
    case sky::bruneton::Level::fine:
      return 2.2;
  }
  return 0;
}

}  // namespace

double slice_seconds(const Plan& plan) { return kSliceGroupSeconds * groups(plan); }

double table_seconds(const Plan& plan) {
  return table_group_seconds(plan.job.sky.level) * groups(plan);
}

double multiple_scattering_seconds(const Plan& plan) {
  return table_seconds(plan) * per_frame(plan) + kMultipleShareOfSlice * slice_seconds(plan);
}

double further_orders_seconds(const Plan& plan) {
  return kFurtherOrders * table_seconds(plan) * per_frame(plan);
}

double full_tables_seconds(const Plan& plan) { return table_seconds(plan) * per_frame(plan) / 2; }

double full_spectrum_seconds(const Plan& plan) {
  return table_seconds(plan) * per_frame(plan) + slice_seconds(plan);
}

double stop_below(sky::bruneton::Level level) {
  return sky::bruneton::settings_for(level, sky::atmosphere::Medium{}).stop_below;
}

}  // namespace skylapse::plan::rates
