#pragma once
#include "output/image_writer.h"

namespace skylapse::output::imageio {

/// See ImageIo::read.
Result<ReadImage> read(const std::string& path, int part, const ReadLimits& limits);

/// See ImageIo::read_header.
Result<ReadImage> read_header(const std::string& path, int part, const ReadLimits& limits);

}  // namespace skylapse::output::imageio
