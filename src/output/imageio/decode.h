#pragma once
#include "output/image_writer.h"

namespace skylapse::output::imageio {

/// The first three channels of the first image of a file (R, G, B by name where there are such
/// names; a grey image three times). NaN and Inf pass through. See ImageIo::decode.
/// Errors: missing_input with the library's reason.
Result<DecodedImage> decode(const std::string& path);

}  // namespace skylapse::output::imageio
