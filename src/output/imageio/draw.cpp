#include "output/imageio/draw.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

namespace skylapse::output::imageio {
namespace {

OIIO::ImageSpec spec_of(int width, int height) {
  return OIIO::ImageSpec(width, height, 3, OIIO::TypeFloat);
}

Error failed(const std::string& what, const OIIO::ImageBuf& buffer) {
  return {.code = ErrorCode::internal, .message = what + ": " + buffer.geterror()};
}

}  // namespace

Result<image::FrameBuffer> resized(const image::FrameBuffer& image, int width, int height) {
  // The buffer is only read, though the wrapping type does not say so.
  const OIIO::ImageBuf source(spec_of(image.width(), image.height()),
                              const_cast<float*>(image.data().data()));
  image::FrameBuffer result(width, height);
  OIIO::ImageBuf target(spec_of(width, height), result.data().data());
  if (!OIIO::ImageBufAlgo::resize(target, source, "triangle", 0, {}, 1))
    return failed("an image could not be resized", target);
  return result;
}

Status draw_text(image::FrameBuffer& image, int x, int y, int height, const std::string& text) {
  OIIO::ImageBuf target(spec_of(image.width(), image.height()), image.data().data());
  const float white[] = {1, 1, 1};
  if (!OIIO::ImageBufAlgo::render_text(target, x, y, text, height, "DejaVuSans", white))
    (void)target.geterror();  // no font here: the sheet goes without labels
  return Done{};
}

}  // namespace skylapse::output::imageio
