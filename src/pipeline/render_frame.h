#pragma once
// The one function that reads like the product: sun -> sky -> ground -> disc -> image.
#include <functional>
#include <optional>

#include "image/frame_buffer.h"
#include "pipeline/atmosphere_service.h"
#include "pipeline/reference_sky.h"
#include "pipeline/stage_times.h"
#include "plan/plan.h"

namespace skylapse::pipeline {

struct RenderedFrame {
  image::FrameBuffer scene;  // scene-linear in the job's space; 1.0 is 683 cd/m^2
  std::optional<image::FrameBuffer> scene_without_disc;  // if asked for
  glm::dvec3 sky_irradiance_xyz{0};  // horizontal, W m^-2 with CIE weights, without the disc
  glm::dvec3 sun_irradiance_xyz{0};  // horizontal, of the disc above the horizon
  glm::dvec3 sun_normal_irradiance_xyz{0};
  std::optional<FrameNoise> noise;  // of the model `reference`
};

/// Renders one frame of a plan. `atmospheres` serves the models that compute the air; Hosek-Wilkie
/// leaves it alone. `keep_without_disc` also returns the sky as it is before the disc is added.
/// `progress` is told the share of a picture that takes long and answers whether to go on; a no
/// ends in the error `interrupted`.
/// Deterministic: the same plan, frame and driver give the same pixels on any number of threads.
Result<RenderedFrame> render_frame(const plan::Plan& plan, const plan::Frame& frame,
                                   AtmosphereService& atmospheres, bool keep_without_disc,
                                   StageTimes& times,
                                   const std::function<bool(double)>& progress = {});

}  // namespace skylapse::pipeline
