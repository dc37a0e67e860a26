#pragma once
// Pictures whose pixels are so coarse that the light at their centres would not do.
#include <functional>

#include "core/result.h"
#include "image/camera/camera.h"
#include "image/frame_buffer.h"

namespace skylapse::pipeline {

/// Pixels around the horizon from which on the centres of pixels do: with them the sky's irradiance
/// of level ground is right within 0.03 % at a height of 30 km and 0.02 % on the ground; with 64 it
/// would be 4 % and 0.4 % (benchmarks/hdri/sizes.py).
inline constexpr int kFineAround = 512;

/// Number of finer pixels in a row and column of each pixel that the picture needs: 1 for all that
/// do not light scenes, that is, that do not show the whole upper hemisphere.
int finer_samples(const image::Camera& camera);

/// The whole picture in which each pixel is the mean, by solid angle, of n x n finer ones; those
/// outside the picture are left out. A pixel whose centre is outside is black. The irradiance of
/// level ground is at most that of the finer picture: see sky::sink_to_level.
/// `fill`: fills rows of a picture of the camera it is given, as FrameSky::fill.
Result<image::FrameBuffer> averaged_picture(
    const image::Camera& camera, int n,
    const std::function<Status(const image::Camera&, image::FrameBuffer&)>& fill);

}  // namespace skylapse::pipeline
