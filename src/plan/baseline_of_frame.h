#pragma once
// The baselines, Preetham and the CIE general sky, for frames: what they answer, what they refuse.
#include "plan/plan.h"
#include "sky/fitted_sky.h"

namespace skylapse::plan {

constexpr bool is_baseline(config::SkyModel model) {
  return model == config::SkyModel::preetham || model == config::SkyModel::cie;
}

/// The sky that a frame asks for, the sun where the frame has it; still to be multiplied by
/// SunForSky::distance_factor. Errors: the model's own. `model` is a baseline (asserted).
Result<sky::FittedSky> baseline_of_frame(const config::JobConfig& job, config::SkyModel model,
                                         const Frame& frame);

/// Refuses in words what a baseline cannot do: a site above kNearGround, a sun that has set,
/// turbidity beyond its formulas. Nothing for other models.
Status check_baseline(const Plan& plan);

}  // namespace skylapse::plan
