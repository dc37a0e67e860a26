#include "output/imageio/encode.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <functional>
#include <span>

#include "output/stored_numbers.h"
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
Status check_half_range(std::span<const float> values) {
  size_t beyond = 0;
  float largest = 0;
  for (const float v : values) {
    const float a = std::fabs(v);
    beyond += a > kLargestHalf ? 1 : 0;  // NaN is not beyond: it has its own half float
    largest = a > largest ? a : largest;
  }
  if (beyond == 0) return Done{};
  return refusal(std::to_string(beyond) + " samples of up to " + std::to_string(largest) +
                     " do not fit a half float (65504)",
                 "write 32-bit floats, or choose the sun policy clip, scale or split");
}

/// RGBE knows neither Inf nor NaN.
Status check_rgbe_range(std::span<const float> values) {
  const auto fits = [](float v) { return v <= kLargestRgbe && v > -kLargestRgbe; };
  const auto beyond = size_t(std::count_if(values.begin(), values.end(), std::not_fn(fits)));
  if (beyond == 0) return Done{};
  return refusal(std::to_string(beyond) + " samples are not finite or beyond " +
                     std::to_string(kLargestRgbe) + ": .hdr cannot hold them",
                 "write .exr with 32-bit floats");
}

Status check(const EncodeRequest& r) {
  const auto& all = formats();
  const auto rules = std::find_if(all.begin(), all.end(),
                                  [&](const FormatRules& f) { return f.name == r.format; });
  if (rules == all.end())
    return refusal("unknown image format '" + r.format + "'",
                   "known: " + listed(all, [](const FormatRules& f) { return f.name; }));
  if (r.width <= 0 || r.height <= 0)
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
  const bool rgb = r.channels == EncodeRequest{}.channels;
  if (r.channels.empty() || (r.format != "exr" && !rgb))
    return refusal("." + r.format + " files hold R, G and B here", "write .exr");
  if (r.format == "jpg" && (r.quality < 1 || r.quality > 100))
    return refusal("jpeg quality " + std::to_string(r.quality) + " is out of range",
                   "allowed: 1 to 100");
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
  OIIO::ImageSpec spec(r.width, r.height, int(r.channels.size()), file_type(r.type));
  spec.channelnames = r.channels;
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

/// The library's idea of a file, over a sink. Small writes are gathered: some packers write a byte
/// at a time.
class SinkProxy final : public OIIO::Filesystem::IOProxy {
 public:
  SinkProxy(const std::string& name, ByteSink& sink) : IOProxy(name, Mode::Write), sink_(sink) {}
  const char* proxytype() const override { return "skylapse"; }
  void close() override { flush_gathered(); }
  bool seek(int64_t offset) override {
    m_pos = offset;
    return true;
  }
  size_t write(const void* bytes, size_t size) override {
    const size_t written = pwrite(bytes, size, m_pos);
    m_pos += int64_t(written);
    return written;
  }
  size_t pwrite(const void* bytes, size_t size, int64_t offset) override {
    constexpr size_t kMost = size_t{1} << 20;
    const auto at = uint64_t(offset);
    if (at != start_ + gathered_.size() || gathered_.size() + size > kMost) {
      if (!flush_gathered()) return 0;
      start_ = at;
    }
    const auto* const begin = static_cast<const std::byte*>(bytes);
    if (size > kMost) {
      if (!(fine_ = sink_.write_at(at, {begin, size}))) return 0;
      start_ = at + size;
    } else {
      gathered_.insert(gathered_.end(), begin, begin + size);
    }
    end_ = std::max(end_, at + size);
    return size;
  }
  size_t size() const override { return end_; }
  /// False if any write failed.
  bool flush_gathered() {
    if (fine_ && !gathered_.empty()) fine_ = sink_.write_at(start_, gathered_);
    start_ += gathered_.size();
    gathered_.clear();
    return fine_;
  }

 private:
  ByteSink& sink_;
  std::vector<std::byte> gathered_;
  uint64_t start_ = 0, end_ = 0;
  bool fine_ = true;
};

class OiioRowWriter final : public RowWriter {
 public:
  OiioRowWriter(EncodeRequest request, ByteSink& sink)
      : request_(std::move(request)), proxy_("frame." + request_.format, sink) {}

  Status open() {
    out_ = OIIO::ImageOutput::create("frame." + request_.format);
    if (!out_) return library_failure(request_, OIIO::geterror());
    out_->set_ioproxy(&proxy_);
    if (!out_->open("frame." + request_.format, make_spec(request_))) return failure();
    return Done{};
  }

  Status add(const void* pixels, int rows) override {
    assert(rows > 0 && next_row_ + rows <= request_.height);
    const void* samples = pixels;
    const size_t count = request_.channels.size() * size_t(request_.width) * size_t(rows);
    if (request_.type == SampleType::half_float) {
      const Status fits = check_half_range({static_cast<const float*>(pixels), count});
      if (!fits) return fits;
    }
    if (request_.format == "hdr") {
      const auto* const begin = static_cast<const float*>(pixels);
      const Status fits = check_rgbe_range({begin, count});
      if (!fits) return fits;
      rounded_.assign(begin, begin + count);
      prepare_for_truncating_rgbe(rounded_);
      samples = rounded_.data();
    }
    const bool half = request_.type == SampleType::half_float;
    const OIIO::TypeDesc type =
        half ? OIIO::TypeDesc(OIIO::TypeDesc::FLOAT) : file_type(request_.type);
    if (!out_->write_scanlines(next_row_, next_row_ + rows, 0, type, samples)) return failure();
    next_row_ += rows;
    return Done{};
  }

  Status finish() override {
    assert(next_row_ == request_.height);
    const bool closed = out_->close();
    const Status state = closed ? Status(Done{}) : failure();
    out_.reset();  // some writers finish the file only now
    if (!state) return state;
    if (!proxy_.flush_gathered()) return library_failure(request_, "the bytes were not taken");
    return Done{};
  }

 private:
  Error failure() { return library_failure(request_, out_->geterror()); }
  EncodeRequest request_;
  SinkProxy proxy_;  // before the library's object, which uses it to its end
  std::unique_ptr<OIIO::ImageOutput> out_;
  std::vector<float> rounded_;
  int next_row_ = 0;
};

/// Bytes in memory.
class MemorySink final : public ByteSink {
 public:
  bool write_at(uint64_t offset, std::span<const std::byte> bytes) override {
    if (bytes_.size() < offset + bytes.size()) bytes_.resize(offset + bytes.size());
    std::copy(bytes.begin(), bytes.end(), bytes_.begin() + ptrdiff_t(offset));
    return true;
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace

Result<std::unique_ptr<RowWriter>> open_rows(const EncodeRequest& request, ByteSink& sink) {
  if (Status ok = check(request); !ok) return ok.error();
  auto writer = std::make_unique<OiioRowWriter>(request, sink);
  if (Status opened = writer->open(); !opened) return opened.error();
  return std::unique_ptr<RowWriter>(std::move(writer));
}

Result<std::vector<std::byte>> encode(const EncodeRequest& request) {
  if (request.pixels == nullptr) return refusal("an image without pixels cannot be encoded", "");
  MemorySink memory;
  {
    auto writer = open_rows(request, memory);
    if (!writer) return writer.error();
    if (Status added = (*writer)->add(request.pixels, request.height); !added) return added.error();
    if (Status finished = (*writer)->finish(); !finished) return finished.error();
  }
  return memory.take();
}

}  // namespace skylapse::output::imageio
