#pragma once
#include <vector>

#include "plan/plan.h"

namespace skylapse::plan {

/// Fills Frame::ev for all frames. Sun curve and fixed exposure need the sun alone; `metered`
/// reads the sky model's own light in each frame and follows it with the rate limit inside a
/// sequence.
Status plan_exposure(Plan& plan);

/// Mean luminance of a frame's sky without the disc: the model's own horizontal illuminance by the
/// sky, divided by pi; extrapolation included. What the meter looks at: horizontal light with the
/// sun in it would underrate a sky whose sun is low.
Result<Luminance> model_sky_luminance(const config::JobConfig& job, const Frame& frame);

}  // namespace skylapse::plan
