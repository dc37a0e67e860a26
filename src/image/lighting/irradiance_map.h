#pragma once
// What diffuse surfaces receive, by their normal.
#include <span>

#include "image/camera/camera.h"
#include "image/frame_buffer.h"
#include "image/lighting/point_light.h"

namespace skylapse::image {

/// Side of the cube that an irradiance map of so many pixels is summed over.
int irradiance_source_side(size_t pixels);

/// Irradiance of a surface whose normal is a pixel's direction, by the picture of a whole sphere
/// (a cube as vertical strip, without what is in `lights`) and by point lights:
///   E(n) = pi sum(L Omega max(0, n w)) / sum(Omega max(0, n w)) + sum(E_k max(0, n w_k)).
/// The quotient makes an even sky of radiance L give pi L exactly. In the picture's radiance unit
/// times steradian; black where `camera` shows nothing. The same for any number of threads.
/// Error: the cube is summed in 24576 pieces (6144 for maps above 24576 pixels); 5e-4 of a clear
/// sky's irradiance, measured against a sum that is 16 times finer.
FrameBuffer irradiance_map(const Camera& camera, const Camera& sky_camera, const FrameBuffer& sky,
                           std::span<const PointLight> lights);

}  // namespace skylapse::image
