#pragma once
#include "plan/plan.h"
#include "sky/hosek_wilkie/sky.h"

namespace skylapse::plan {

/// The sky that a frame asks for: turbidity, ground and sun of the frame, the disc at its true
/// size. Radiances still have to be multiplied by SunForSky's factors.
Result<sky::hosek_wilkie::Sky> sky_of_frame(const config::JobConfig& job, const Frame& frame);

/// Ground reflectance of the frame, in the model's bands.
sky::AlbedoSpectrum ground_of_frame(const config::JobConfig& job, const Frame& frame);

}  // namespace skylapse::plan
