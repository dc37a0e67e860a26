#pragma once
// Latitude-longitude map (OpenEXR ENVMAP_LATLONG axes): row 0 ends at the zenith, the last row at
// the nadir; the image centre is the heading and azimuth grows to the right.
//   longitude = (x / width - 1/2) 360 deg,   zenith angle = y / height 180 deg
#include "image/camera/camera.h"

namespace skylapse::image {

/// Direction of any position. Beyond the left and right edge the map repeats; beyond the zenith
/// and the nadir it goes on over the pole.
Direction<CameraFrame> lat_long_ray(const Camera& camera, PixelPosition position);

/// Where a direction falls, x in [0, width]. The poles are put into the middle column.
PixelPosition lat_long_position(const Camera& camera, const Direction<CameraFrame>& direction);

double lat_long_solid_angle_sr(const Camera& camera, int y);

}  // namespace skylapse::image
