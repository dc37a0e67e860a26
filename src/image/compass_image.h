#pragma once
// A picture that proves how a camera is oriented.
#include "image/camera/camera.h"
#include "image/frame_buffer.h"

namespace skylapse::image {

/// The six marks of the compass image: a disc of 12 deg radius with a letter that stands upright
/// (towards the zenith; on the up and down marks its top points north) and is not mirrored.
enum class CompassMark { north, east, south, west, up, down };

/// Colour of a mark's disc, linear, in [0, 1]: north red, east yellow, south cyan, west blue,
/// up white, down black. Its letter is black, on the down mark white.
glm::vec3 compass_color(CompassMark mark);

/// Sky blue-grey, ground brown, lines every 30 deg of azimuth and elevation, the horizon in green,
/// and the six marks. Values in [0, 1]; black where the camera sees nothing.
FrameBuffer compass_image(const Camera& camera);

}  // namespace skylapse::image
