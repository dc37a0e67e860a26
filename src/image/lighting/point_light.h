#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "core/frames.h"

namespace skylapse::image {

/// Light from a direction, too small to have a size: a piece of the sun's disc.
struct PointLight {
  Direction<Enu> direction;
  glm::dvec3 irradiance{0};  // of a surface that faces it, in a picture's radiance unit times sr
};

}  // namespace skylapse::image
