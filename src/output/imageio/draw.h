#pragma once
#include "output/image_writer.h"

namespace skylapse::output::imageio {

/// See ImageIo::resized and ImageIo::draw_text.
Result<image::FrameBuffer> resized(const image::FrameBuffer& image, int width, int height);
Status draw_text(image::FrameBuffer& image, int x, int y, int height, const std::string& text);

}  // namespace skylapse::output::imageio
