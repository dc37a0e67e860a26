#include "diff_cases/image.h"

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <stdexcept>

namespace skylapse::diff_cases {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
  throw std::runtime_error(path.string() + ": " + why);
}

OIIO::ImageSpec make_spec(const Image& image, const FileOptions& options) {
  const std::string type = !options.type.empty() ? options.type
                           : image.bits == 8     ? "uint8"
                           : image.bits == 16    ? "uint16"
                                                 : "float";
  OIIO::ImageSpec spec(image.width, image.height, image.channel_count(), OIIO::TypeDesc(type));
  if (!image.attributes_of.empty()) {
    const auto like = OIIO::ImageInput::open(image.attributes_of.string());
    if (!like) fail(image.attributes_of, OIIO::geterror());
    spec.extra_attribs = like->spec().extra_attribs;
  }
  spec.channelnames = image.channels;
  for (int c = 0; c < image.channel_count(); ++c)
    if (image.channels[size_t(c)] == "A") spec.alpha_channel = c;
  spec.attribute("compression", options.compression);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  if (options.bottom_first) spec.attribute("openexr:lineOrder", "decreasingY");
  if (options.tile > 0) spec.tile_width = spec.tile_height = options.tile;
  for (const auto& [name, value] : options.text) spec.attribute(name, value);
  for (const auto& [name, value] : options.numbers) spec.attribute(name, value);
  for (const auto& [name, value] : options.floats) spec.attribute(name, value);
  for (const std::string& name : options.without) spec.erase_attribute(name);
  return spec;
}

/// Code values as the integers they are.
template <class Integer>
std::vector<Integer> integers(const Image& image) {
  std::vector<Integer> values(image.samples.size());
  for (size_t i = 0; i < values.size(); ++i) values[i] = Integer(image.samples[i]);
  return values;
}

OIIO::ImageBuf buffer(const Image& image) {
  OIIO::ImageBuf buf(
      OIIO::ImageSpec(image.width, image.height, image.channel_count(), OIIO::TypeDesc::FLOAT));
  buf.set_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, image.samples.data());
  return buf;
}

}  // namespace

void write_image(const std::filesystem::path& path, const Image& image,
                 const FileOptions& options) {
  const auto out = OIIO::ImageOutput::create(path.string());
  if (!out) fail(path, OIIO::geterror());
  if (!out->open(path.string(), make_spec(image, options))) fail(path, out->geterror());
  bool fine = false;
  if (image.bits == 8)
    fine = out->write_image(OIIO::TypeDesc::UINT8, integers<uint8_t>(image).data());
  else if (image.bits == 16)
    fine = out->write_image(OIIO::TypeDesc::UINT16, integers<uint16_t>(image).data());
  else
    fine = out->write_image(OIIO::TypeDesc::FLOAT, image.samples.data());
  if (!fine || !out->close()) fail(path, out->geterror());
}

Image read_image(const std::filesystem::path& path) {
  const auto in = OIIO::ImageInput::open(path.string());
  if (!in) fail(path, OIIO::geterror());
  const OIIO::ImageSpec& spec = in->spec();
  Image image(spec.width, spec.height);
  image.channels = spec.channelnames;
  image.attributes_of = path;
  image.samples.resize(size_t(spec.width) * size_t(spec.height) * size_t(spec.nchannels));
  if (!in->read_image(0, 0, 0, image.channel_count(), OIIO::TypeDesc::FLOAT, image.samples.data()))
    fail(path, in->geterror());
  const bool integer = !spec.format.is_floating_point();
  image.bits = integer ? int(spec.format.size()) * 8 : 32;
  const float top = image.bits == 8 ? 255.0F : 65535.0F;
  if (integer)
    for (float& v : image.samples) v = float(int(v * top + 0.5F));
  return image;
}

Image blurred(const Image& image, float size) {
  const OIIO::ImageBuf kernel = OIIO::ImageBufAlgo::make_kernel("gaussian", size, size);
  const OIIO::ImageBuf result = OIIO::ImageBufAlgo::convolve(buffer(image), kernel);
  Image out = image;
  result.get_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, out.samples.data());
  return out;
}

Image as_half(const Image& image) {
  Image out = image;
  const int count = int(image.samples.size());
  std::vector<uint16_t> halves(image.samples.size());
  OIIO::convert_types(OIIO::TypeDesc::FLOAT, image.samples.data(), OIIO::TypeDesc::HALF,
                      halves.data(), count);
  OIIO::convert_types(OIIO::TypeDesc::HALF, halves.data(), OIIO::TypeDesc::FLOAT,
                      out.samples.data(), count);
  return out;
}

Noise::Noise(int width, int height, uint32_t seed)
    : width_(width), values_(size_t(width) * size_t(height) * 3) {
  uint32_t state = seed;
  for (double& value : values_) {
    state = 1664525U * state + 1013904223U;
    value = double(state >> 8U) / 16777216.0;
  }
}

}  // namespace skylapse::diff_cases
