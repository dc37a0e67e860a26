#include "output/imageio/read.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <shared_mutex>
#include <string_view>
#include <utility>

#include "output/imageio/header_check.h"
#include "output/imageio/isolated_read.h"
#include "output/imageio/orientation.h"
#include "output/imageio/reader_choice.h"

namespace skylapse::output::imageio {
namespace {

using image::SampleStorage;

constexpr float kLargestUint32 = 4294967295.0F;

/// Columns [x0, x1) and rows [y0, y1).
struct Window {
  int64_t x0, y0, x1, y1;
  [[nodiscard]] int64_t width() const { return x1 - x0; }
  [[nodiscard]] int64_t height() const { return y1 - y0; }
  [[nodiscard]] bool holds(const Window& w) const {
    return w.x0 >= x0 && w.x1 <= x1 && w.y0 >= y0 && w.y1 <= y1;
  }
};

Window stored_window(const OIIO::ImageSpec& s) {
  return {s.x, s.y, int64_t{s.x} + s.width, int64_t{s.y} + s.height};
}

/// What is shown. Formats other than OpenEXR know offsets, but no picture beside the stored one. Of
/// tiled cube maps OpenImageIO names one face.
Window shown_window(const OIIO::ImageSpec& s, bool exr) {
  const bool cube = s.get_string_attribute("textureformat") == "CubeFace Environment";
  if (!exr || cube || s.full_width <= 0 || s.full_height <= 0) return stored_window(s);
  return {s.full_x, s.full_y, int64_t{s.full_x} + s.full_width, int64_t{s.full_y} + s.full_height};
}

Window common_part(const Window& a, const Window& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

/// Why a picture with this header is not read; empty: it is.
std::string refusal(const OIIO::ImageSpec& spec, bool exr, const ReadLimits& limits) {
  if (spec.deep) return "it holds deep pixels";
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels < 1) return "it holds no pixels";
  if (spec.depth > 1) return "it is a volume";
  if (spec.nchannels > limits.channels)
    return "it has " + std::to_string(spec.nchannels) +
           " channels (allowed: " + std::to_string(limits.channels) + ")";
  const auto shown = shown_window(spec, exr);
  for (const Window& w : {stored_window(spec), shown}) {
    const auto pixels = static_cast<long double>(w.width()) * static_cast<long double>(w.height());
    const long double bytes = pixels * sizeof(float) * static_cast<unsigned>(spec.nchannels);
    if (pixels > static_cast<long double>(limits.pixels) ||
        bytes > static_cast<long double>(limits.bytes))
      return std::to_string(w.width()) + " x " + std::to_string(w.height()) + " pixels with " +
             std::to_string(spec.nchannels) + " channels are more than is read (" +
             std::to_string(limits.pixels) + " pixels, " + std::to_string(limits.bytes) + " bytes)";
  }
  const Window common = common_part(stored_window(spec), shown);
  if (common.width() <= 0 || common.height() <= 0)
    return "its data window lies outside of its display window";
  return {};
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

bool is_lossy(const std::string& format, const std::string& compression) {
  if (format == "openexr")
    return compression.starts_with("pxr24") || compression.starts_with("b44") ||
           compression.starts_with("dwa");
  if (format == "tiff") return compression.starts_with("jpeg");
  return format == "jpeg" || format == "jpeg2000" || format == "webp" || format == "heif" ||
         format == "gif" || format == "dds";
}

SampleStorage storage_of(const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const ReadImage& image) {
  SampleStorage s;
  s.lossy = is_lossy(image.format, image.compression);
  s.bits = int(type.basesize() * 8);
  if (image.format == "hdr") return {SampleStorage::Kind::rgbe, 8, s.lossy};
  if (type.basetype == OIIO::TypeDesc::HALF) {
    s.kind = SampleStorage::Kind::half_float;
  } else if (!type.is_floating_point()) {
    s.kind = SampleStorage::Kind::integer;
    const int stored = spec.get_int_attribute("oiio:BitsPerSample");
    if (stored > 0 && stored < s.bits && image.format != "ico") s.bits = stored;
  }
  return s;
}

/// Everything but the samples.
void describe(const OIIO::ImageSpec& spec, ReadImage& image) {
  const bool exr = image.format == "openexr";
  image.compression = spec.get_string_attribute("compression");
  image.part_name = spec.get_string_attribute("oiio:subimagename");
  for (int c = 0; c < spec.nchannels; ++c) {
    const std::string name = spec.channel_name(c);
    image.channels.push_back(name.empty() ? "channel" + std::to_string(c) : name);
    image.storage.push_back(storage_of(spec, spec.channelformat(c), image));
  }
  for (const OIIO::ParamValue& p : spec.extra_attribs)
    if (auto a = to_attribute(p, exr)) image.attributes.push_back(std::move(*a));
}

class PartReader {
 public:
  PartReader(OIIO::ImageInput& input, int part, const OIIO::ImageSpec& spec, const Window& shown)
      : input_(input), part_(part), spec_(spec), shown_(shown), stored_(stored_window(spec)) {}

  /// False: the input's error text says why.
  bool into(std::vector<float>& samples) {
    return shown_.holds(stored_) ? straight(samples) : cropped(samples);
  }

 private:
  [[nodiscard]] size_t pixel() const { return size_t(spec_.nchannels); }
  float* at(std::vector<float>& samples, int64_t x, int64_t y) const {
    return samples.data() +
           pixel() * (size_t(y - shown_.y0) * size_t(shown_.width()) + size_t(x - shown_.x0));
  }
  bool straight(std::vector<float>& samples) {
    const auto step = OIIO::stride_t(pixel() * sizeof(float));
    return input_.read_image(part_, 0, 0, spec_.nchannels, OIIO::TypeFloat,
                             at(samples, stored_.x0, stored_.y0), step, step * shown_.width());
  }
  /// A data window that reaches beyond what is shown: in bands, of which a part is kept. What is
  /// not kept is read as well: it tells a file that was cut short.
  bool cropped(std::vector<float>& samples) {
    const Window kept = common_part(stored_, shown_);
    const int64_t rows = spec_.tile_height > 0 ? spec_.tile_height : 64;
    std::vector<float> band(pixel() * size_t(stored_.width() * rows));
    for (int64_t y = stored_.y0; y < stored_.y1; y += rows) {
      const int64_t end = std::min(y + rows, stored_.y1);
      if (!read_band(y, end, band.data())) return false;
      for (int64_t row = std::max(y, kept.y0); row < std::min(end, kept.y1); ++row) {
        const float* const from =
            band.data() +
            pixel() * (size_t(row - y) * size_t(stored_.width()) + size_t(kept.x0 - stored_.x0));
        std::copy_n(from, pixel() * size_t(kept.width()), at(samples, kept.x0, row));
      }
    }
    return true;
  }
  bool read_band(int64_t y, int64_t end, float* band) {
    if (spec_.tile_width > 0)
      return input_.read_tiles(part_, 0, spec_.x, spec_.x + spec_.width, int(y), int(end), spec_.z,
                               spec_.z + 1, 0, spec_.nchannels, OIIO::TypeFloat, band);
    return input_.read_scanlines(part_, 0, int(y), int(end), spec_.z, 0, spec_.nchannels,
                                 OIIO::TypeFloat, band);
  }
  OIIO::ImageInput& input_;
  int part_;
  const OIIO::ImageSpec& spec_;
  Window shown_, stored_;
};

/// OpenEXR's integers count things; the library has made shares of 2^32 - 1 of them.
void restore_counts(const OIIO::ImageSpec& spec, std::vector<float>& samples) {
  const auto channels = size_t(spec.nchannels);
  for (size_t c = 0; c < channels; ++c) {
    if (spec.channelformat(int(c)).basetype != OIIO::TypeDesc::UINT32) continue;
    for (size_t i = c; i < samples.size(); i += channels)
      samples[i] = float(std::round(double(samples[i]) * double(kLargestUint32)));
  }
}

/// The library's words, first line; it may have none.
std::string reason(OIIO::ImageInput& input) {
  const std::string why = input.geterror();
  return why.empty() ? "it is damaged" : why.substr(0, why.find('\n'));
}

/// Of formats that hold several and do not say how many, by trying.
int parts_of(OIIO::ImageInput& input, const OIIO::ImageSpec& first, const std::string& format) {
  const int told = first.get_int_attribute("oiio:subimages");
  if (told > 0) return told;
  constexpr std::array<std::string_view, 4> kSeveral{"tiff", "gif", "ico", "psd"};
  if (std::ranges::count(kSeveral, format) == 0) return 1;
  int parts = 1;
  while (parts < 65536 && input.seek_subimage(parts, 0)) ++parts;
  (void)input.geterror();  // of the part that is not there
  return parts;
}

enum class Wanted { header, picture };

Result<ReadImage> read_open(const std::string& path, OIIO::ImageInput& input, ReadImage image,
                            int part, const ReadLimits& limits, Wanted wanted) {
  const bool exr = image.format == "openexr";
  image.parts = parts_of(input, input.spec(), image.format);
  if (part < 0 || part >= image.parts || !input.seek_subimage(part, 0))
    return unreadable(path, "it has no part " + std::to_string(part));
  const OIIO::ImageSpec spec = input.spec();
  if (const std::string why = refusal(spec, exr, limits); !why.empty())
    return unreadable(path, why);
  describe(spec, image);
  const Window shown = shown_window(spec, exr);
  image.width = int(shown.width());
  image.height = int(shown.height());
  const int orientation = spec.get_int_attribute("Orientation", 1);
  if (wanted == Wanted::header) {
    if (is_transposed(orientation)) std::swap(image.width, image.height);
    return image;
  }
  image.samples.resize(size_t(shown.width() * shown.height()) * size_t(spec.nchannels));
  const bool read = PartReader(input, part, spec, shown).into(image.samples);
  // A TIFF or JPEG that ends early is reported as read, with black for the rest: only the text of
  // the error tells.
  if (!read || input.has_error()) return unreadable(path, reason(input));
  if (exr) restore_counts(spec, image.samples);
  put_upright(orientation, image);
  return image;
}

/// Readers that stood the fuzzing; the others work in a process of their own.
constexpr std::array<std::string_view, 6> kSturdy{"openexr", "png", "jpeg", "tiff", "hdr", "pnm"};

Result<ReadImage> read_with(OIIO::ImageInput& input, const std::string& path,
                            const std::string& format, int part, const ReadLimits& limits,
                            Wanted wanted) {
  try {
    OIIO::ImageSpec config, spec;
    config.attribute("oiio:UnassociatedAlpha", 1);  // as stored: not multiplied by alpha
    if (!input.open(path, spec, config)) return unreadable(path, reason(input));
    ReadImage image;
    image.format = format;
    return read_open(path, input, std::move(image), part, limits, wanted);
  } catch (const std::bad_alloc&) {
    return unreadable(path, "there is not enough memory for it");
  } catch (const std::exception& thrown) {  // of libraries behind the library
    return unreadable(path, thrown.what());
  }
}

Result<ReadImage> read_file(const std::string& path, int part, const ReadLimits& limits,
                            Wanted wanted) {
  const auto format = reader_for(path);
  if (!format) return format.error();
  if (const std::string why = header_problem(path, *format, limits); !why.empty())
    return unreadable(path, why);
  std::shared_lock with_others(library_in_use());
  const auto input = OIIO::ImageInput::create(*format);
  if (!input) return unreadable(path, "no reader for " + *format + " images is installed");
  const auto read_it = [&] { return read_with(*input, path, *format, part, limits, wanted); };
  if (std::ranges::count(kSturdy, *format) > 0) return read_it();
  with_others.unlock();
  return read_in_child(path, limits, read_it);
}

}  // namespace

Result<ReadImage> read(const std::string& path, int part, const ReadLimits& limits) {
  return read_file(path, part, limits, Wanted::picture);
}

Result<ReadImage> read_header(const std::string& path, int part, const ReadLimits& limits) {
  return read_file(path, part, limits, Wanted::header);
}

}  // namespace skylapse::output::imageio
