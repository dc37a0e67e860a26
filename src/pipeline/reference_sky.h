#pragma once
// The sky of a frame by tracing paths: no GL, no tables, noise with its standard error.
#include <functional>

#include "image/frame_buffer.h"
#include "pipeline/frame_sky.h"
#include "sky/monte_carlo/reference_image.h"

namespace skylapse::pipeline {

/// How sure a picture is that was made from random paths.
struct FrameNoise {
  image::FrameBuffer standard_error;  // of each value of the scene without the disc, as the scene
  sky::monte_carlo::ReferenceImageRecord record;
  double sky_irradiance_error = 0;  // relative, at most, of the horizontal illuminance by the sky
};

/// The options of the job's paths for a frame: the seed follows from sky.seed and the frame's
/// moment, so that noise moves in time and repeats on resume.
sky::monte_carlo::ReferenceOptions reference_options(const plan::Plan& plan,
                                                     const plan::Frame& frame);

/// `progress`: told the share of the frame's pixels that is done, answers whether to go on.
Result<FrameSky> reference_sky(const plan::Plan& plan, const plan::Frame& frame,
                               const std::function<bool(double)>& progress);

}  // namespace skylapse::pipeline
