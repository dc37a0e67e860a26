#pragma once
// The one symbol of the image module (libskylapse_imageio.so) that the loader asks for.
#include "output/image_writer.h"

namespace skylapse::output {

/// Raised whenever image_writer.h, FrameBuffer or Result change their layout.
inline constexpr unsigned kImageModuleAbi = 4;
inline constexpr const char* kImageModuleFactory = "skylapse_open_image_module";
inline constexpr const char* kImageModuleFile = "libskylapse_imageio.so";

/// Returns the process-wide ImageIo, or null when `abi` is not the one the module was built with.
using ImageModuleFactory = const ImageIo* (*)(unsigned abi);

}  // namespace skylapse::output
