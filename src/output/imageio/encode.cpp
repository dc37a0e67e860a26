#include "output/imageio/encode.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <system_error>

#include "output/sun_policy.h"

namespace skylapse::output::imageio {
namespace {

struct FormatRules {
  std::string name;
  std::vector<SampleType> types;
  std::vector<std::string> compressions;  // empty: the request's compression is not used
};

const std::vector<FormatRules>& formats() {
  using enum SampleType;
  static const std::vector<FormatRules> all{
      {"exr", {half_float, float32}, {"none", "zip", "zips", "piz", "dwaa"}},
      {"hdr", {float32}, {}},
      {"png", {u8, u16}, {}},
      {"jpg", {u8}, {}},
      {"tif", {u8, u16, half_float, float32}, {"none", "zip", "lzw"}},
  };
  return all;
}

OIIO::TypeDesc file_type(SampleType type) {
  switch (type) {
    case SampleType::u8:
      return OIIO::TypeDesc::UINT8;
    case SampleType::u16:
      return OIIO::TypeDesc::UINT16;
    case SampleType::half_float:
      return OIIO::TypeDesc::HALF;
    case SampleType::float32:
      return OIIO::TypeDesc::FLOAT;
  }
  return OIIO::TypeDesc::UNKNOWN;
}

Error refusal(std::string message, std::string hint) {
  return {.code = ErrorCode::invalid_input, .message = std::move(message), .hint = std::move(hint)};
}

template <class Range, class Name>
std::string listed(const Range& range, Name name) {
  std::string text;
  for (const auto& item : range) text += (text.empty() ? "" : ", ") + name(item);
  return text;
}

/// Half floats turn larger values into Inf without a word; the caller's sun policy comes first.
Status check_half_range(const EncodeRequest& r) {
  const auto* p = static_cast<const float*>(r.pixels);
  const size_t samples = size_t{3} * static_cast<size_t>(r.width) * static_cast<size_t>(r.height);
  size_t beyond = 0;
  float largest = 0;
  for (size_t i = 0; i < samples; ++i) {
    const float a = std::fabs(p[i]);
    beyond += a > kLargestHalf ? 1 : 0;  // NaN is not beyond: it has its own half float
    largest = a > largest ? a : largest;
  }
  if (beyond == 0) return Done{};
  return refusal(std::to_string(beyond) + " samples of up to " + std::to_string(largest) +
                     " do not fit a half float (65504)",
                 "write 32-bit floats, or choose the sun policy clip, scale or split");
}

Status check(const EncodeRequest& r) {
  const auto& all = formats();
  const auto rules = std::find_if(all.begin(), all.end(),
                                  [&](const FormatRules& f) { return f.name == r.format; });
  if (rules == all.end())
    return refusal("unknown image format '" + r.format + "'",
                   "known: " + listed(all, [](const FormatRules& f) { return f.name; }));
  if (r.width <= 0 || r.height <= 0 || r.pixels == nullptr)
    return refusal("an image without pixels cannot be encoded", "");
  if (std::find(rules->types.begin(), rules->types.end(), r.type) == rules->types.end())
    return refusal("." + r.format + " files cannot hold " + file_type(r.type).c_str() + " samples",
                   "possible: " + listed(rules->types, [](SampleType t) {
                     return std::string(file_type(t).c_str());
                   }));
  const auto& packing = rules->compressions;
  if (!packing.empty() && std::find(packing.begin(), packing.end(), r.compression) == packing.end())
    return refusal("." + r.format + " files have no compression '" + r.compression + "'",
                   "known: " + listed(packing, [](const std::string& s) { return s; }));
  if (r.format == "jpg" && (r.quality < 1 || r.quality > 100))
    return refusal("jpeg quality " + std::to_string(r.quality) + " is out of range",
                   "allowed: 1 to 100");
  if (r.type == SampleType::half_float) return check_half_range(r);
  return Done{};
}

/// Shortest text that reads back as the same number.
template <class Number>
std::string to_text(Number value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string to_text(const std::vector<float>& values) {
  return listed(values, [](float v) { return to_text(v); });
}
std::string to_text(const std::string& value) { return value; }

void add_attribute(OIIO::ImageSpec& spec, const Attribute& a, bool as_text) {
  if (as_text) {  // PNG text chunks know strings only
    spec.attribute(a.name, std::visit([](const auto& v) { return to_text(v); }, a.value));
  } else if (const auto* i = std::get_if<int>(&a.value)) {
    spec.attribute(a.name, *i);
  } else if (const auto* f = std::get_if<float>(&a.value)) {
    spec.attribute(a.name, *f);
  } else if (const auto* d = std::get_if<double>(&a.value)) {
    spec.attribute(a.name, OIIO::TypeDesc(OIIO::TypeDesc::DOUBLE), d);
  } else if (const auto* s = std::get_if<std::string>(&a.value)) {
    spec.attribute(a.name, *s);
  } else {
    const auto& v = std::get<std::vector<float>>(a.value);
    spec.attribute(a.name, OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, static_cast<int>(v.size())),
                   v.data());
  }
}

/// The time stamp goes under OpenImageIO's own name. Without one the library would put the present
/// time into the file, another one in each run: a number in its place is left out instead.
void add_time_stamp(OIIO::ImageSpec& spec, const EncodeRequest& r) {
  if (r.format == "png") return;  // a text chunk like the others; no chunk is made unasked
  for (const Attribute& a : r.attributes) {
    const auto* const text = std::get_if<std::string>(&a.value);
    if (a.name == "capDate" && text != nullptr) return spec.attribute("DateTime", *text);
  }
  spec.attribute("DateTime", 0);
}

/// Settings of the packers, weighed for sequences of 1280 x 720 (figures in docs/color.md).
void add_packing(OIIO::ImageSpec& spec, const EncodeRequest& r) {
  constexpr int kPngFilterSub = 0x10;
  if (r.format == "exr" || r.format == "tif") spec.attribute("compression", r.compression);
  if (r.format == "tif") spec.attribute("tiff:zipquality", 2);
  if (r.format == "jpg") {
    spec.attribute("compression", "jpeg:" + std::to_string(r.quality));
    spec.attribute("jpeg:subsampling", "4:4:4");
  }
  if (r.format == "png") {
    spec.attribute("png:compressionLevel", 1);
    spec.attribute("png:filter", kPngFilterSub);
  }
}

OIIO::ImageSpec make_spec(const EncodeRequest& r) {
  OIIO::ImageSpec spec(r.width, r.height, 3, file_type(r.type));
  for (const Attribute& a : r.attributes)
    if (a.name != "capDate" || r.format == "png") add_attribute(spec, a, r.format == "png");
  add_time_stamp(spec, r);
  add_packing(spec, r);
  if (r.type == SampleType::half_float && r.format == "tif") spec.attribute("tiff:half", 1);
  return spec;
}

Error library_failure(const EncodeRequest& r, const std::string& why) {
  return {.code = ErrorCode::internal, .message = "cannot encode ." + r.format + ": " + why};
}

/// Bytes of an anonymous memory file, for writers that insist on a file name.
class MemoryFile {
 public:
  MemoryFile() : fd_(::memfd_create("skylapse", MFD_CLOEXEC)) {}
  ~MemoryFile() {
    if (fd_ >= 0) ::close(fd_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  [[nodiscard]] bool valid() const { return fd_ >= 0; }
  [[nodiscard]] std::string name() const { return "/proc/self/fd/" + std::to_string(fd_); }
  Result<std::vector<std::byte>> bytes() const {
    const off_t size = ::lseek(fd_, 0, SEEK_END);
    std::vector<std::byte> all(static_cast<size_t>(std::max<off_t>(size, 0)));
    for (size_t done = 0; done < all.size();) {
      const ssize_t n =
          ::pread(fd_, all.data() + done, all.size() - done, static_cast<off_t>(done));
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return Error{.message = std::generic_category().message(errno)};
      done += static_cast<size_t>(n);
    }
    return all;
  }

 private:
  int fd_;
};

/// Opens, writes, closes. Empty text is success.
std::string write_image(OIIO::ImageOutput& out, const EncodeRequest& r, const std::string& name) {
  const OIIO::ImageSpec spec = make_spec(r);
  if (!out.open(name, spec)) return out.geterror();
  const bool half = r.type == SampleType::half_float;
  const OIIO::TypeDesc type = half ? OIIO::TypeDesc(OIIO::TypeDesc::FLOAT) : file_type(r.type);
  if (!out.write_image(type, r.pixels)) return out.geterror();
  return out.close() ? std::string() : out.geterror();
}

}  // namespace

Result<std::vector<std::byte>> encode(const EncodeRequest& request) {
  if (Status ok = check(request); !ok) return ok.error();
  auto out = OIIO::ImageOutput::create("frame." + request.format);
  if (!out) return library_failure(request, OIIO::geterror());
  if (out->supports("ioproxy")) {
    std::vector<unsigned char> buffer;
    OIIO::Filesystem::IOVecOutput memory(buffer);
    out->set_ioproxy(&memory);
    const std::string failure = write_image(*out, request, "frame." + request.format);
    out.reset();  // some writers finish the file only now
    if (!failure.empty()) return library_failure(request, failure);
    const auto* begin = reinterpret_cast<const std::byte*>(buffer.data());
    return std::vector<std::byte>(begin, begin + buffer.size());
  }
  const MemoryFile memory;
  if (!memory.valid()) return library_failure(request, std::generic_category().message(errno));
  const std::string failure = write_image(*out, request, memory.name());
  out.reset();
  if (!failure.empty()) return library_failure(request, failure);
  return memory.bytes();
}

}  // namespace skylapse::output::imageio
