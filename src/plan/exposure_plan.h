#pragma once
#include <vector>

#include "plan/plan.h"

namespace skylapse::plan {

/// Fills Frame::ev for all frames. Sun curve and fixed exposure need the sun alone; `metered`
/// asks the sky model for the horizontal illuminance of each frame and follows it with the rate
/// limit inside a sequence.
Status plan_exposure(Plan& plan);

/// Horizontal illuminance of a frame by the sky model: sky and sun, extrapolation included.
Result<Illuminance> model_illuminance(const config::JobConfig& job, const Frame& frame);

}  // namespace skylapse::plan
