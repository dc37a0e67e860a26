#pragma once
#include "output/image_writer.h"

namespace skylapse::output::imageio {

/// The file of `request` in memory, through OpenImageIO. See ImageIo::encode.
/// Errors (invalid_input): unknown format, sample type or compression that the format has not, an
/// empty image, a half float beyond 65504.
Result<std::vector<std::byte>> encode(const EncodeRequest& request);

/// See ImageIo::open_rows.
Result<std::unique_ptr<RowWriter>> open_rows(const EncodeRequest& request, ByteSink& sink);

}  // namespace skylapse::output::imageio
