#pragma once
// Perspective: a pinhole before a plane. Pixels are square; the field of view is horizontal.
#include "image/camera/camera.h"

namespace skylapse::image {

/// Distance of the image plane in pixels: width / 2 / tan(fov / 2).
double perspective_focal_length_px(const Camera& camera);

/// Direction of any position of the image plane, outside the picture too. Finite positions only.
Direction<CameraFrame> perspective_ray(const Camera& camera, PixelPosition position);

/// Where a direction meets the image plane, outside the picture too; nothing from behind.
std::optional<PixelPosition> perspective_position(const Camera& camera,
                                                  const Direction<CameraFrame>& direction);

double perspective_solid_angle_sr(const Camera& camera, int x, int y);

}  // namespace skylapse::image
