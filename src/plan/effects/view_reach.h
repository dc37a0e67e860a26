#pragma once
// What a camera can see: the extremes of its picture.
#include <vector>

#include "image/camera/camera.h"

namespace skylapse::plan {

/// Least and greatest elevation of what touches a pixel: the picture's edge, widened by two of the
/// largest pixels, since pixels at the horizon are means over their height.
struct ViewReach {
  Angle lowest = -90 * deg, highest = 90 * deg;
};
ViewReach view_reach(const image::Camera& camera);

/// Side of the picture's largest and smallest pixel, as the root of its solid angle, by a raster of
/// samples.
struct PixelSides {
  Angle smallest, largest;
};
PixelSides pixel_sides(const image::Camera& camera);

/// Whether any part of the disc of angular radius `reach` about `centre` is in the picture.
bool disc_in_picture(const image::Camera& camera, const Direction<Enu>& centre, Angle reach);

}  // namespace skylapse::plan
