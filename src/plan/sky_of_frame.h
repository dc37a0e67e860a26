#pragma once
#include "plan/plan.h"
#include "sky/hosek_wilkie/sky.h"

namespace skylapse::plan {

/// The sky that a frame asks for: turbidity, ground and sun of the frame, the disc at its true
/// size. Radiances still have to be multiplied by SunForSky's factors.
Result<sky::hosek_wilkie::Sky> sky_of_frame(const config::JobConfig& job, const Frame& frame);

/// Illuminance by the Hosek-Wilkie sky alone at sun elevation 0, for an air and ground of the job;
/// 0 for a baseline, which nothing continues below the horizon.
Result<Illuminance> sky_at_horizon(const config::JobConfig& job, int turbidity, int albedo);

/// Ground reflectance of the frame, in the model's bands.
sky::AlbedoSpectrum ground_of_frame(const config::JobConfig& job, const Frame& frame);

}  // namespace skylapse::plan
