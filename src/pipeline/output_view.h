#pragma once
// The camera of an output, turned the way its renderer wants it.
#include <array>
#include <optional>

#include "plan/plan.h"

namespace skylapse::pipeline {

/// How an image output looks at the sky of a frame.
struct OutputView {
  config::CameraConfig camera;
  /// Faces of the camera's strip in the order in which the output has them, in files of their own
  /// or in a strip.
  std::array<int, 6> faces{0, 1, 2, 3, 4, 5};
  [[nodiscard]] bool reorders_faces() const { return faces != OutputView{}.faces; }
};

/// Turned to the heading of an orientation; one without, or one that cannot be turned, stays.
image::Camera oriented(image::Camera camera, std::optional<image::Orientation> orientation);

/// The output's own view, else that of the frame's camera. A map or cube with an orientation has
/// the heading of that convention, and its order of the faces.
OutputView view_of_output(const plan::Plan& plan, const plan::Frame& frame,
                          const config::ImageOutput& output);

}  // namespace skylapse::pipeline
