#include "output/ktx2.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/parallel.h"
#include "core/version.h"
#include "image/lighting/cube_mips.h"
#include "output/stored_numbers.h"

namespace skylapse::output {
namespace {

static_assert(std::endian::native == std::endian::little, "KTX 2 is little-endian");

constexpr size_t kHeaderBytes = 80, kLevelIndexBytes = 24;
constexpr uint32_t kFormatRgba16f = 97, kFormatRgba32f = 109;  // VkFormat

class Bytes {
 public:
  template <class T>
  void put(T value) {
    const auto* p = reinterpret_cast<const std::byte*>(&value);
    data_.insert(data_.end(), p, p + sizeof value);
  }
  void put_text(const std::string& text) {
    const auto* p = reinterpret_cast<const std::byte*>(text.data());
    data_.insert(data_.end(), p, p + text.size());
  }
  void pad_to(size_t alignment) {
    while (data_.size() % alignment != 0) data_.push_back(std::byte{0});
  }
  [[nodiscard]] size_t size() const { return data_.size(); }
  [[nodiscard]] std::vector<std::byte>& data() { return data_; }

 private:
  std::vector<std::byte> data_;
};

/// khr_df_primaries_e. AP1 is listed as ACEScc's, AP0 as ACES's.
uint8_t primaries_of(color::RgbSpace space) {
  switch (space) {
    case color::RgbSpace::rec709:
      return 1;
    case color::RgbSpace::rec2020:
      return 4;
    case color::RgbSpace::aces2065_1:
      return 6;
    case color::RgbSpace::acescg:
      break;
  }
  return 7;
}

/// Data Format Descriptor with its total size.
Bytes descriptor(color::RgbSpace space, uint8_t channel_bytes) {
  constexpr uint16_t kVersion1_3 = 2, kBlockBytes = 24 + 4 * 16;
  constexpr uint8_t kRgbsda = 1, kLinear = 1, kAlphaStraight = 0;
  constexpr uint8_t kFloat = 0x80, kSigned = 0x40;
  Bytes b;
  b.put(uint32_t{4 + kBlockBytes});
  b.put(uint32_t{0});  // vendor Khronos, type basic format
  b.put(kVersion1_3);
  b.put(kBlockBytes);
  b.put(kRgbsda);
  b.put(primaries_of(space));
  b.put(kLinear);
  b.put(kAlphaStraight);
  b.put(uint32_t{0});                                 // texel block of 1 x 1 x 1 x 1: each less one
  b.put(uint64_t{4} * channel_bytes);                 // bytes of plane 0; no other planes
  for (const uint32_t channel : {0U, 1U, 2U, 15U}) {  // red, green, blue, alpha
    const uint32_t index = std::min(channel, 3U);
    b.put(uint16_t(8 * channel_bytes * index));  // bit offset
    b.put(uint8_t(8 * channel_bytes - 1));       // bits less one
    b.put(uint8_t(channel | kFloat | kSigned));
    b.put(uint32_t{0});  // position
    b.put(-1.0F);        // what floats call their nominal range
    b.put(1.0F);
  }
  return b;
}

Bytes key_values(const KtxCube& cube) {
  std::vector<std::pair<std::string, std::string>> all = cube.notes;
  all.emplace_back("KTXorientation", "rd");
  all.emplace_back("KTXwriter", std::string("skylapse ") + kVersion);
  std::sort(all.begin(), all.end());  // the specification asks for the order of code points
  Bytes b;
  for (const auto& [key, value] : all) {
    b.put(uint32_t(key.size() + 1 + value.size() + 1));
    b.put_text(key + '\0' + value + '\0');
    b.pad_to(4);
  }
  return b;
}

uint16_t half_bits(float value) {
  const float rounded = rounded_to_half(value);
  const auto bits = std::bit_cast<uint32_t>(rounded);
  const uint32_t sign = (bits >> 16) & 0x8000U, magnitude = bits & 0x7fffffffU;
  constexpr uint32_t kSmallestNormal = 0x38800000U, kBias = 0x38000000U;  // 2^-14; 112 << 23
  if (magnitude >= kSmallestNormal) return uint16_t(sign | ((magnitude - kBias) >> 13));
  return uint16_t(sign | uint32_t(std::abs(rounded) * 0x1p24F));  // multiples of 2^-24
}

/// Six faces of a level as RGBA.
template <class Sample, class Convert>
std::vector<Sample> texels(const image::FrameBuffer& strip,
                           const std::array<image::CubeFace, 6>& faces, const Convert& convert) {
  const size_t side = size_t(strip.width());
  std::vector<Sample> out(4 * strip.pixel_count());
  const Sample one = convert(1.0F);
  parallel_for_ranges(6 * side, std::max<size_t>(1, 16384 / side), [&](size_t begin, size_t end) {
    for (size_t row = begin; row < end; ++row) {
      const size_t face = static_cast<size_t>(faces[row / side]);
      const float* p = strip.row(int(face * side + row % side));
      Sample* q = out.data() + 4 * side * row;
      for (size_t x = 0; x < side; ++x, p += 3, q += 4) {
        for (int c = 0; c < 3; ++c) q[c] = convert(p[c]);
        q[3] = one;
      }
    }
  });
  return out;
}

Status check_values(const KtxCube& cube) {
  const bool half = cube.type == SampleType::half_float;
  for (const image::FrameBuffer& level : cube.levels)
    for (const float v : level.data())
      if (!std::isfinite(half ? rounded_to_half(v) : v))
        return Error{ErrorCode::invalid_input, "a texture holds a value that is no " +
                                                   std::string(half ? "half " : "") +
                                                   "float: " + std::to_string(v)};
  return Done{};
}

void put_level(Bytes& out, const KtxCube& cube, size_t level) {
  const auto append = [&](const auto& values) {
    const size_t at = out.size(), bytes = values.size() * sizeof values[0];
    out.data().resize(at + bytes);
    std::memcpy(out.data().data() + at, values.data(), bytes);
  };
  if (cube.type == SampleType::half_float)
    append(texels<uint16_t>(cube.levels[level], cube.faces, half_bits));
  else
    append(texels<float>(cube.levels[level], cube.faces, [](float v) { return v; }));
}

/// Where the levels lie: from the smallest to the largest, each at a multiple of a texel.
struct Layout {
  std::vector<size_t> offsets, bytes;  // of each level, the largest first
  size_t end = 0;
};

Layout layout_of(const KtxCube& cube, size_t texel_bytes, size_t first) {
  const size_t levels = cube.levels.size();
  Layout layout{std::vector<size_t>(levels), std::vector<size_t>(levels), first};
  for (size_t i = levels; i-- > 0;) {
    const image::FrameBuffer& strip = cube.levels[i];
    assert(strip.width() == image::level_side(cube.levels[0].width(), int(i)));
    assert(strip.height() == 6 * strip.width());
    layout.offsets[i] = (layout.end + texel_bytes - 1) / texel_bytes * texel_bytes;
    layout.bytes[i] = texel_bytes * strip.pixel_count();
    layout.end = layout.offsets[i] + layout.bytes[i];
  }
  return layout;
}

void put_header(Bytes& out, const KtxCube& cube, size_t dfd_bytes, size_t kvd_bytes) {
  const bool half = cube.type == SampleType::half_float;
  const auto side = uint32_t(cube.levels[0].width());
  const size_t dfd_at = kHeaderBytes + kLevelIndexBytes * cube.levels.size();
  out.put_text("\xabKTX 20\xbb\r\n\x1a\n");
  for (const uint32_t field : {half ? kFormatRgba16f : kFormatRgba32f, half ? 2U : 4U, side, side,
                               0U, 0U, 6U, uint32_t(cube.levels.size()), 0U})
    out.put(field);
  for (const size_t field : {dfd_at, dfd_bytes, dfd_at + dfd_bytes, kvd_bytes})
    out.put(uint32_t(field));
  out.put(uint64_t{0});  // no global data
  out.put(uint64_t{0});
  assert(out.size() == kHeaderBytes);
}

}  // namespace

Result<std::vector<std::byte>> ktx2_file(const KtxCube& cube) {
  assert(!cube.levels.empty());
  assert(cube.type == SampleType::half_float || cube.type == SampleType::float32);
  const Status values = check_values(cube);
  if (!values) return values.error();
  const uint8_t channel_bytes = cube.type == SampleType::half_float ? 2 : 4;
  const size_t texel_bytes = size_t{4} * channel_bytes, levels = cube.levels.size();
  Bytes dfd = descriptor(cube.space, channel_bytes), kvd = key_values(cube);
  const size_t index_end = kHeaderBytes + kLevelIndexBytes * levels;
  const Layout layout = layout_of(cube, texel_bytes, index_end + dfd.size() + kvd.size());
  Bytes out;
  out.data().reserve(layout.end);
  put_header(out, cube, dfd.size(), kvd.size());
  for (size_t i = 0; i < levels; ++i)
    for (const size_t field : {layout.offsets[i], layout.bytes[i], layout.bytes[i]})
      out.put(uint64_t(field));
  for (Bytes* part : {&dfd, &kvd})
    out.data().insert(out.data().end(), part->data().begin(), part->data().end());
  for (size_t i = levels; i-- > 0;) {
    out.pad_to(texel_bytes);
    assert(out.size() == layout.offsets[i]);
    put_level(out, cube, i);
  }
  return std::move(out.data());
}

}  // namespace skylapse::output
