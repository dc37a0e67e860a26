// The factory of the image module, and the ImageIo that hands the work to encode, decode, display.
#include <OpenColorIO/OpenColorIO.h>
#include <OpenImageIO/imageio.h>

#include "core/parallel.h"
#include "output/imageio/decode.h"
#include "output/imageio/display.h"
#include "output/imageio/draw.h"
#include "output/imageio/encode.h"
#include "output/imageio/module_abi.h"
#include "output/imageio/read.h"
#include "output/imageio/reader_choice.h"

namespace skylapse::output {
namespace {

class ModuleImageIo final : public ImageIo {
 public:
  ModuleImageIo() {
    const int threads = allowed_threads();
    OIIO::attribute("threads", threads);
    OIIO::attribute("exr_threads", threads);
    OIIO::attribute("debug", 0);  // the Debian build writes notes to stderr otherwise
    OCIO_NAMESPACE::SetLoggingLevel(OCIO_NAMESPACE::LOGGING_LEVEL_NONE);
  }
  Result<std::vector<std::byte>> encode(const EncodeRequest& request) const override {
    return imageio::encode(request);
  }
  Result<std::unique_ptr<RowWriter>> open_rows(const EncodeRequest& request,
                                               ByteSink& sink) const override {
    return imageio::open_rows(request, sink);
  }
  Result<DecodedImage> decode(const std::string& path) const override {
    return imageio::decode(path);
  }
  Result<ReadImage> read(const std::string& path, int part,
                         const ReadLimits& limits) const override {
    return imageio::read(path, part, limits);
  }
  Result<std::unique_ptr<DisplayTransform>> display(const DisplayRequest& request) const override {
    return imageio::make_display_transform(request);
  }
  Result<std::vector<std::string>> views(const std::string& config_file) const override {
    return imageio::list_views(config_file);
  }
  Result<image::FrameBuffer> resized(const image::FrameBuffer& image, int width,
                                     int height) const override {
    return imageio::resized(image, width, height);
  }
  Status draw_text(image::FrameBuffer& image, int x, int y, int height,
                   const std::string& text) const override {
    return imageio::draw_text(image, x, y, height, text);
  }
  Result<ReadImage> read_header(const std::string& path, int part,
                                const ReadLimits& limits) const override {
    return imageio::read_header(path, part, limits);
  }
  std::vector<std::string> readable_extensions() const override {
    return imageio::readable_extensions();
  }
  std::string versions() const override {
    const int v = OIIO::openimageio_version();
    return "OpenImageIO " + std::to_string(v / 10000) + "." + std::to_string(v / 100 % 100) + "." +
           std::to_string(v % 100) + ", OpenColorIO " + OCIO_NAMESPACE::GetVersion();
  }
};

}  // namespace
}  // namespace skylapse::output

extern "C" __attribute__((visibility("default"))) const skylapse::output::ImageIo*
skylapse_open_image_module(unsigned abi) {
  if (abi != skylapse::output::kImageModuleAbi) return nullptr;
  static const skylapse::output::ModuleImageIo image_io;
  return &image_io;
}
