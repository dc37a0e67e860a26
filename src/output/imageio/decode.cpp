#include "output/imageio/decode.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace skylapse::output::imageio {
namespace {

Error unreadable(const std::string& path, const std::string& why) {
  return {.code = ErrorCode::missing_input, .message = "cannot read image '" + path + "': " + why};
}

/// Channel numbers of red, green and blue.
std::array<int, 3> rgb_channels(const OIIO::ImageSpec& spec) {
  if (spec.nchannels < 3) return {0, 0, 0};
  const int r = spec.channelindex("R");
  const int g = spec.channelindex("G");
  const int b = spec.channelindex("B");
  if (r >= 0 && g >= 0 && b >= 0) return {r, g, b};
  return {0, 1, 2};
}

/// OpenImageIO renames some of OpenEXR's attributes on reading; ours keep the names of the file.
std::string stored_name(const std::string& name, bool exr) {
  if (!exr) return name;
  if (name == "DateTime") return "capDate";
  if (name == "ExposureTime") return "expTime";
  if (name == "FNumber") return "aperture";
  return name;
}

std::optional<Attribute> to_attribute(const OIIO::ParamValue& p, bool exr) {
  const std::string name = stored_name(p.name().string(), exr);
  const OIIO::TypeDesc type = p.type();
  if (type == OIIO::TypeString) return Attribute{name, std::string(p.get_string())};
  if (type == OIIO::TypeInt) return Attribute{name, p.get<int>()};
  if (type == OIIO::TypeFloat) return Attribute{name, p.get<float>()};
  if (type == OIIO::TypeDesc(OIIO::TypeDesc::DOUBLE)) return Attribute{name, p.get<double>()};
  if (type.basetype == OIIO::TypeDesc::FLOAT) {
    const size_t n = type.numelements() * type.aggregate;
    const auto* values = static_cast<const float*>(p.data());
    return Attribute{name, std::vector<float>(values, values + n)};
  }
  return {};
}

}  // namespace

Result<DecodedImage> decode(const std::string& path) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);  // as stored: not multiplied by alpha
  const auto input = OIIO::ImageInput::open(path, &config);
  if (!input) return unreadable(path, OIIO::geterror());
  const OIIO::ImageSpec spec = input->spec();
  if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels < 1 || spec.deep)
    return unreadable(path, "it is not a flat two-dimensional image");
  const std::array<int, 3> rgb = rgb_channels(spec);
  const int first = std::min({rgb[0], rgb[1], rgb[2]});
  const int count = std::max({rgb[0], rgb[1], rgb[2]}) - first + 1;
  DecodedImage image;
  image.pixels = image::FrameBuffer(spec.width, spec.height);
  std::vector<float> loose;
  const bool direct = count == 3 && rgb[0] == first && rgb[1] == first + 1;
  if (!direct) loose.resize(image.pixels.pixel_count() * static_cast<size_t>(count));
  float* const target = direct ? image.pixels.data().data() : loose.data();
  const bool read = input->read_image(0, 0, first, first + count, OIIO::TypeFloat, target);
  // A TIFF or JPEG that ends early is reported as read, with black for the rest: only the text of
  // the error tells.
  if (const std::string why = input->geterror(); !read || !why.empty())
    return unreadable(path, why.substr(0, why.find('\n')));
  for (size_t i = 0; !direct && i < image.pixels.pixel_count(); ++i)
    for (size_t c = 0; c < 3; ++c)
      image.pixels.data()[3 * i + c] =
          loose[i * static_cast<size_t>(count) + static_cast<size_t>(rgb[c] - first)];
  const bool exr = std::string_view(input->format_name()) == "openexr";
  for (const OIIO::ParamValue& p : spec.extra_attribs)
    if (auto a = to_attribute(p, exr)) image.attributes.push_back(std::move(*a));
  image.floating_point = spec.format.is_floating_point();
  const int stored = spec.get_int_attribute("oiio:BitsPerSample");
  image.stored_bits = stored > 0 ? stored : static_cast<int>(spec.format.size() * 8);
  return image;
}

}  // namespace skylapse::output::imageio
