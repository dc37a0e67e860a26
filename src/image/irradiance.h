#pragma once
// What an image shines onto a surface: sums of radiance over its pixels.
#include <glm/glm.hpp>

#include "image/camera/camera.h"
#include "image/frame_buffer.h"

namespace skylapse::image {

/// Per channel, in the image's radiance unit times steradian. Each pixel counts with the solid
/// angle of pixel_solid_angle and the direction of its centre; sums are in double, and the same
/// for any number of threads.
struct ImageFlux {
  glm::dvec3 total{0};                  // sum of L Omega over all pixels
  glm::dvec3 horizontal_irradiance{0};  // sum of L Omega sin(elevation) over the upper hemisphere
};

/// `camera` and `image` have the same size (asserted). Not-a-number pixels make the sums NaN.
ImageFlux image_flux(const Camera& camera, const FrameBuffer& image);

/// Irradiance of the ground by the image: image_flux(...).horizontal_irradiance.
glm::dvec3 image_irradiance(const Camera& camera, const FrameBuffer& image);

}  // namespace skylapse::image
