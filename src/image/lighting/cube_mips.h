#pragma once
// Levels of a cube map: vertical strips (camera.h) of a side, half of it, a quarter...
#include <vector>

#include "image/camera/camera.h"
#include "image/frame_buffer.h"

namespace skylapse::image {

/// Side of a level: the first one's, halved `level` times and rounded down, at least 1; as OpenGL,
/// Vulkan and KTX 2 count.
int level_side(int side, int level);
/// Levels down to the first whose side is at most `smallest`.
int level_count(int side, int smallest);

/// The cube camera of a strip with this side, heading as `like`.
Camera strip_camera(const Camera& like, int side);

/// A smaller cube: each pixel is the mean of what it covers, weighted with solid angles of the
/// parts, so the sum of radiance times solid angle stays to the rounding of floats, for any two
/// sides. `strip` is a vertical strip; 1 <= side <= its own (asserted).
FrameBuffer shrunk_cube(const FrameBuffer& strip, int side);

/// The strip itself and `levels` - 1 smaller ones, each made from the one before.
std::vector<FrameBuffer> box_mips(FrameBuffer strip, int levels);

}  // namespace skylapse::image
