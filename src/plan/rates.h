#pragma once
// What the parts of a computed atmosphere cost on one core, as the benchmarks measured them on
// software GL; shared by the cost of a job and the cost of an effect.
#include "sky/bruneton/settings.h"

namespace skylapse::plan {

struct Plan;

namespace rates {

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
