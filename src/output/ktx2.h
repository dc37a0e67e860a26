#pragma once
// Cube maps with mips in the Khronos texture format, KTX 2.0.
// Source   Khronos, "KTX File Format Specification", version 2.0; "Khronos Data Format
//          Specification" 1.3, basic descriptor block; Vulkan 1.2, VkFormat.
//
// What is written, all little-endian:
//   header    vkFormat R16G16B16A16_SFLOAT (97) or R32G32B32A32_SFLOAT (109): four channels, since
//             three are not a texture format that GPUs must have, nor one that three.js knows;
//             alpha is 1. typeSize 2 or 4, width = height = side, no depth, no layers, six faces
//   index     of 24 bytes for each level, the largest first
//   DFD       one basic block: RGBSDA, primaries of the colour space, linear, alpha straight
//   key/value KTXorientation "rd" (rows down, the only one that cubes may have), KTXwriter, `notes`
//   levels    the smallest first, each aligned to a texel; faces +X -X +Y -Y +Z -Z, in which
//             left-handed frame each is a plain view from inside (docs/conventions.md)
// No supercompression. The same request gives the same bytes.
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "color/rgb_space.h"
#include "image/camera/cube.h"
#include "image/frame_buffer.h"
#include "output/image_writer.h"

namespace skylapse::output {

struct KtxCube {
  /// Vertical strips of faces oriented as OpenEXR's, the largest first; sides are halved and
  /// rounded down (image::level_side) from one to the next (asserted).
  std::span<const image::FrameBuffer> levels;
  /// Which of the strip's faces are the file's: image::faces_in.
  std::array<image::CubeFace, 6> faces = image::kCubeFaces;
  SampleType type = SampleType::half_float;  // or float32 (asserted)
  color::RgbSpace space = color::RgbSpace::rec709;
  /// Keys and values of our own, UTF-8 without NUL; keys must not begin with "KTX" or "ktx"
  /// (asserted).
  std::vector<std::pair<std::string, std::string>> notes = {};
};

/// The file. Half floats are rounded to the nearest; values beyond 65504 and NaN are an error
/// (invalid_input): what becomes of them is decided before.
Result<std::vector<std::byte>> ktx2_file(const KtxCube& cube);

}  // namespace skylapse::output
