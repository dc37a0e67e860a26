#pragma once
// A cube's pixels as sources of light.
#include <glm/glm.hpp>
#include <vector>

#include "image/camera/camera.h"
#include "image/frame_buffer.h"
#include "image/lighting/zonal_kernel.h"

namespace skylapse::image {

/// In the strip's reading order, in east-north-up. Their radiance is what it is more than the
/// sphere's mean, the reference: sums of it are small, and of an even sky exactly nothing.
struct SphereSources {
  std::vector<kernel::Source> pieces;
  glm::dvec3 reference{0};
};

/// Of a vertical strip; `like` gives its heading.
SphereSources sources_of(const Camera& like, const FrameBuffer& strip);

/// Sum of radiance times solid angle over a strip.
glm::dvec3 flux_of(const FrameBuffer& strip);

}  // namespace skylapse::image
