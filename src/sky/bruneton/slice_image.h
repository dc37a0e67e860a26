#pragma once
// Fills images from a slice of the sky on all cores: the production path.
#include <glm/glm.hpp>

#include "core/frames.h"
#include "image/camera/camera.h"
#include "image/frame_buffer.h"
#include "sky/bruneton/sky_slice.h"

namespace skylapse::sky::bruneton {

/// Level unit vector towards the sun: where azimuths of a slice are 0. North where the sun has no
/// azimuth.
glm::dvec3 level_direction(const Direction<Enu>& sun);

struct SliceImageInputs {
  const SkySlice* slice = nullptr;  // not null
  /// Where the sun stands; its azimuth is what counts, the zenith angle is the slice's. In the
  /// zenith and the nadir, where it has none, any azimuth gives the same picture.
  Direction<Enu> sun;
  glm::dmat3 xyz_to_rgb{1.0};  // to the linear space of the image
  double scale = 1.0;          // factor on everything (distance of the sun)
};

/// Fills every pixel of `out`, whose size is the camera's: sky and ground without the sun's disc, 0
/// outside a fisheye circle, on the blank parts of a cross, and above the air (a camera in space).
///
/// A pixel has the radiance of its centre; within kMeanPixels of the horizon it is the mean over
/// the pixel's height at its centre's azimuth, since a limb seen from far may be thinner than a
/// pixel: sky and ground are mixed there by image::horizon_coverage, and what of the pixel lies
/// above the air is black. The height of a pixel is that of its row in a lat-long map, else the
/// root of its solid angle; the horizon is taken to be straight across it.
///
/// Negative results (colours outside the space) become 0, sky and ground each for itself. Error
/// against SkySlice::radiance_xyz, relative to the largest channel of the pixel: below 1e-5
/// everywhere (tested).
/// The result does not depend on the number of threads.
void render_slice(const image::Camera& camera, const SliceImageInputs& inputs,
                  image::FrameBuffer& out);

/// The same for the rows [first_row, first_row + out.height()) of the camera's image, for images
/// that are made in pieces; out.width() is the camera's.
void render_slice_rows(const image::Camera& camera, const SliceImageInputs& inputs, int first_row,
                       image::FrameBuffer& out);

/// Pixels on each side of the horizon that are means instead of the value at their centre.
inline constexpr double kMeanPixels = 2;

}  // namespace skylapse::sky::bruneton
