#pragma once
// Fills images with the Hosek-Wilkie sky on all cores: the production path.
#include <glm/glm.hpp>

#include "core/frames.h"
#include "image/camera/camera.h"
#include "image/frame_buffer.h"
#include "sky/hosek_wilkie/sky.h"

namespace skylapse::sky::hosek_wilkie {

struct ImageInputs {
  const Sky* sky = nullptr;    // not null
  Direction<Enu> sun;          // where the sun stands in the picture
  glm::dmat3 xyz_to_rgb{1.0};  // to the linear space of the image
  double scale = 1.0;          // factor on the sky (twilight level), not on the ground
  glm::dvec3 ground_rgb{0};    // written below the horizon as it is
};

/// Fills every pixel of `out`, whose size is the camera's: the sky without the sun's disc above
/// the horizon, `ground_rgb` below, both mixed by image::horizon_coverage where a pixel straddles
/// the horizon, 0 outside a fisheye circle and on the blank parts of a cross.
///
/// Negative results (the fit within a degree of the horizon, colours outside the space) become 0:
/// here and nowhere else. Error against Sky::radiance_xyz, relative to max(value, 1e-3 of the
/// sky's scale): below 1e-4 in 99.99 % of pixels, below 2e-3 everywhere (tested).
/// The result does not depend on the number of threads.
void render_sky(const image::Camera& camera, const ImageInputs& inputs, image::FrameBuffer& out);

/// The same for the rows [first_row, first_row + out.height()) of the camera's image, for images
/// that are made in pieces; out.width() is the camera's.
void render_sky_rows(const image::Camera& camera, const ImageInputs& inputs, int first_row,
                     image::FrameBuffer& out);

}  // namespace skylapse::sky::hosek_wilkie
