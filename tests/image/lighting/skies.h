#pragma once
// Skies in closed form, as cubes.
#include <functional>

#include "image/lighting/cube_mips.h"

namespace skylapse::image {

using Radiance = std::function<glm::dvec3(const glm::dvec3& enu)>;

inline FrameBuffer cube_of(const Camera& camera, const Radiance& radiance) {
  FrameBuffer strip(camera.width, camera.height);
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const glm::dvec3 l = radiance(direction_at(camera, {x + 0.5, y + 0.5})->vec());
      for (int c = 0; c < 3; ++c) strip.pixel(x, y)[c] = float(l[c]);
    }
  return strip;
}

inline Camera strip_heading(Angle heading, int side) {
  Camera camera;
  camera.camera_to_enu = look_at(heading, {}, {});
  return strip_camera(camera, side);
}

/// Bright about the sun and at the horizon, dark ground: as steep as a clear sky.
inline glm::dvec3 clear_sky(const glm::dvec3& d) {
  const glm::dvec3 sun = glm::normalize(glm::dvec3{0.6, 0.5, 0.4});
  const double gamma = std::acos(std::clamp(glm::dot(d, sun), -1.0, 1.0));
  if (d.z < 0) return glm::dvec3{0.05, 0.06, 0.04};
  return glm::dvec3{0.3, 0.5, 1} * (0.5 + std::exp(-4 * d.z)) +
         glm::dvec3{6, 5, 4} * std::exp(-6 * gamma);
}

}  // namespace skylapse::image
