#pragma once
// What the parts of a computed atmosphere cost on one core, as the benchmarks measured them on
// software GL; shared by the cost of a job and the cost of an effect.
#include "sky/bruneton/settings.h"
#include "sky/effects.h"

namespace skylapse::plan {

struct Frame;
struct Plan;

namespace rates {

/// Core seconds to compute tables of these sizes for all bands of the plan: time goes with the suns
/// at which points are computed, and with the orders (bench_economies).
double table_seconds(const Plan& plan, const sky::bruneton::Settings& settings);
/// Core seconds of a frame's slices: sizes, steps and what of it is seen, at a guess.
double frame_slice_seconds(const Plan& plan, const Frame& frame, sky::EffectSet effects);
/// Core seconds to mix two sets of tables and hand the mixture to the context, for each byte.
inline constexpr double kBlendSecondsPerByte = 1.5e-9;

/// Core seconds of a whole slice of this plan's bands at the usual size.
double slice_seconds(const Plan& plan);
/// Core seconds to compute the tables of all bands of one air.
double table_seconds(const Plan& plan);
/// What effects add to a frame, the tables' share of it included: spread over the plan's frames.
double multiple_scattering_seconds(const Plan& plan);
double further_orders_seconds(const Plan& plan);
double full_tables_seconds(const Plan& plan);
double full_spectrum_seconds(const Plan& plan);
/// The order that adds less than this is the last of a level's tables.
double stop_below(sky::bruneton::Level level);

}  // namespace rates
}  // namespace skylapse::plan
