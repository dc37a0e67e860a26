#pragma once
// Light beside the level plane, in pixels that are too coarse for it.
#include <glm/glm.hpp>

#include "image/camera/camera.h"
#include "image/frame_buffer.h"
#include "sky/sun_disc.h"

namespace skylapse::sky {

/// A pixel beside the level plane counts with the sine of its centre, so light that stands lower
/// shines onto level ground as if it stood half a pixel high: the sun 1 deg high in a map of 64 x
/// 32 pixels (5.6 deg each) would be 2.8 deg high. These functions sink a share of the light of the
/// pixels whose lower edge is the level plane, the same for all of them, into their mirror images
/// below it, so that level ground receives no more than `most`. The sum of radiance times solid
/// angle is kept, and with it what a wall receives. Channels are on their own. Nothing happens to a
/// channel that is within `most`; where the mirror image is not in the picture, or the pixels
/// beside the plane hold too little, the rest of the excess stays.

/// Of the disc alone. `most`: per channel, in the unit of DiscEnergy::horizontal_irradiance.
void sink_to_level(const image::Camera& camera, const glm::dvec3& most, ProjectedDisc& disc);

/// Of a whole picture of the camera's size (asserted); `most` as image::image_irradiance.
void sink_to_level(const image::Camera& camera, const glm::dvec3& most, image::FrameBuffer& image);

}  // namespace skylapse::sky
