#pragma once
// What a picture asks of a sky, whichever model answers.
#include <functional>
#include <glm/glm.hpp>
#include <memory>

#include "image/camera/camera.h"
#include "image/frame_buffer.h"
#include "pipeline/atmosphere_service.h"
#include "plan/plan.h"
#include "sky/sun_disc.h"

namespace skylapse::pipeline {

struct FrameNoise;

/// Sky, ground and sun of one frame, at the sun's distance.
struct FrameSky {
  /// Fills the rows [first_row, first_row + height of the image) of the camera's picture with all
  /// but the disc, in the space of `xyz_to_rgb`; the image is as wide as the picture.
  std::function<Status(const image::Camera&, const glm::dmat3& xyz_to_rgb, int first_row,
                       image::FrameBuffer&)>
      fill;
  glm::dvec3 sky_irradiance_xyz{0};   // horizontal, without the disc
  sky::SunDisc disc;                  // in XYZ
  std::shared_ptr<FrameNoise> noise;  // of a model that draws paths, filled in by `fill`
};

/// The sky of the plan's model. `progress`: of a picture that takes long, told the share that is
/// done, answers whether to go on; from one thread at a time.
Result<FrameSky> sky_of(const plan::Plan& plan, const plan::Frame& frame,
                        AtmosphereService& atmospheres,
                        const std::function<bool(double)>& progress = {});

}  // namespace skylapse::pipeline
