#pragma once
#include <optional>
#include <string>

#include "image/camera/camera.h"

namespace skylapse::image {

inline constexpr int kMaxImageSide = 65536;

/// What is wrong with a camera, in words that name the value and the allowed range; nothing if it
/// can be used. Every other function of this folder takes a camera without a problem.
std::optional<std::string> camera_problem(const Camera& camera);

}  // namespace skylapse::image
