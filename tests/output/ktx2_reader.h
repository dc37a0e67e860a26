#pragma once
// A reader of KTX 2.0 for tests, written from the specification apart from the writer: it checks
// every field that the specification constrains and reports the first that is wrong.
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace skylapse::output {

struct KtxFile {
  std::string problem;  // empty: a valid file
  uint32_t vk_format = 0, type_size = 0, side = 0, faces = 0, levels = 0;
  uint8_t primaries = 0, transfer = 0;
  std::map<std::string, std::string> key_values;
  struct Level {
    uint32_t side = 0;
    std::vector<float> rgba;  // faces, rows, columns, channels
    [[nodiscard]] const float* texel(uint32_t face, uint32_t x, uint32_t y) const {
      return rgba.data() + 4 * ((size_t{face} * side + y) * side + x);
    }
  };
  std::vector<Level> images;
};

namespace ktx {

class File {
 public:
  explicit File(const std::vector<std::byte>& bytes) : bytes_(bytes) {}
  template <class T>
  T at(size_t offset) {
    T value{};
    if (offset + sizeof(T) > bytes_.size()) {
      fail("the file ends too soon");
      return value;
    }
    std::memcpy(&value, bytes_.data() + offset, sizeof(T));
    return value;
  }
  void require(bool holds, const std::string& what) {
    if (!holds) fail(what);
  }
  [[nodiscard]] size_t size() const { return bytes_.size(); }
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  void fail(const std::string& what) {
    if (problem_.empty()) problem_ = what;
  }
  const std::vector<std::byte>& bytes_;
  std::string problem_;
};

/// From the definition of binary16: sign, five bits of exponent, ten of fraction.
inline float half_value(uint16_t h) {
  const int exponent = (h >> 10) & 31, fraction = h & 1023;
  const double sign = h >> 15 ? -1 : 1;
  if (exponent == 31) return fraction ? NAN : float(sign * INFINITY);
  if (exponent == 0) return float(sign * std::ldexp(fraction, -24));
  return float(sign * std::ldexp(1024 + fraction, exponent - 25));
}

inline void check_descriptor(File& f, size_t at, size_t length, uint32_t channel_bytes,
                             KtxFile& file) {
  f.require(at % 4 == 0, "the descriptor is not aligned to 4");
  f.require(f.at<uint32_t>(at) == length, "dfdTotalSize is not dfdByteLength");
  f.require(f.at<uint32_t>(at + 4) == 0, "not Khronos' basic format block");
  f.require(f.at<uint16_t>(at + 8) == 2, "version of the descriptor");
  const auto block = f.at<uint16_t>(at + 10);
  f.require(block == length - 4, "size of the block");
  f.require(f.at<uint8_t>(at + 12) == 1, "colour model RGBSDA");
  file.primaries = f.at<uint8_t>(at + 13);
  file.transfer = f.at<uint8_t>(at + 14);
  f.require(f.at<uint8_t>(at + 15) == 0, "alpha is straight");
  f.require(f.at<uint32_t>(at + 16) == 0, "texel block of one texel");
  f.require(f.at<uint8_t>(at + 20) == 4 * channel_bytes, "bytes of plane 0");
  for (size_t i = 1; i < 8; ++i) f.require(f.at<uint8_t>(at + 20 + i) == 0, "other planes");
  f.require(block == 24 + 16 * 4, "four samples");
  const uint8_t channels[4] = {0, 1, 2, 15};
  for (size_t i = 0; i < 4; ++i) {
    const size_t s = at + 28 + 16 * i;
    f.require(f.at<uint16_t>(s) == 8 * channel_bytes * i, "bit offset of a sample");
    f.require(f.at<uint8_t>(s + 2) == 8 * channel_bytes - 1, "bit length of a sample");
    f.require(f.at<uint8_t>(s + 3) == (channels[i] | 0x80 | 0x40), "channel: signed float");
    f.require(f.at<uint32_t>(s + 4) == 0, "position of a sample");
    f.require(f.at<float>(s + 8) == -1 && f.at<float>(s + 12) == 1, "range of a float sample");
  }
}

inline void read_key_values(File& f, size_t at, size_t length, KtxFile& file) {
  f.require(at % 4 == 0, "key/value data is not aligned to 4");
  std::string last;
  const size_t end = at + length;
  while (at < end && f.problem().empty()) {
    const auto bytes = f.at<uint32_t>(at);
    f.require(at + 4 + bytes <= end, "a pair lies within the key/value data");
    if (!f.problem().empty()) return;
    std::string pair;
    for (size_t i = 0; i < bytes; ++i) pair.push_back(f.at<char>(at + 4 + i));
    const size_t nul = pair.find('\0');
    f.require(nul != std::string::npos && nul > 0, "a key ends with NUL");
    if (nul == std::string::npos) return;
    const std::string key = pair.substr(0, nul), value = pair.substr(nul + 1);
    f.require(key > last, "keys are sorted and appear once");
    f.require(!value.empty() && value.back() == '\0', "a text ends with NUL");
    if (value.empty()) return;
    file.key_values[key] = value.substr(0, value.size() - 1);
    last = key;
    at += 4 + bytes;
    for (; at % 4 != 0; ++at) f.require(f.at<uint8_t>(at) == 0, "padding is zero");
  }
  f.require(at == end, "key/value data has its length");
}

}  // namespace ktx

inline KtxFile read_ktx2(const std::vector<std::byte>& bytes) {
  ktx::File f(bytes);
  KtxFile file;
  const uint8_t identifier[12] = {0xAB, 0x4B, 0x54, 0x58, 0x20, 0x32,
                                  0x30, 0xBB, 0x0D, 0x0A, 0x1A, 0x0A};
  for (size_t i = 0; i < 12; ++i) f.require(f.at<uint8_t>(i) == identifier[i], "identifier");
  file.vk_format = f.at<uint32_t>(12);
  file.type_size = f.at<uint32_t>(16);
  file.side = f.at<uint32_t>(20);
  file.faces = f.at<uint32_t>(36);
  file.levels = f.at<uint32_t>(40);
  f.require(file.vk_format == 97 || file.vk_format == 109, "VkFormat of four floats");
  const uint32_t channel_bytes = file.vk_format == 97 ? 2 : 4;
  f.require(file.type_size == channel_bytes, "typeSize");
  f.require(file.side > 0 && f.at<uint32_t>(24) == file.side, "a cube's faces are square");
  f.require(f.at<uint32_t>(28) == 0, "pixelDepth of a cube is 0");
  f.require(f.at<uint32_t>(32) == 0, "no layers");
  f.require(file.faces == 6, "six faces");
  f.require(file.levels >= 1 && file.levels <= uint32_t(std::bit_width(file.side)),
            "no more levels than a whole pyramid");
  f.require(f.at<uint32_t>(44) == 0, "no supercompression");
  const size_t dfd_at = f.at<uint32_t>(48), dfd_length = f.at<uint32_t>(52);
  const size_t kvd_at = f.at<uint32_t>(56), kvd_length = f.at<uint32_t>(60);
  f.require(f.at<uint64_t>(64) == 0 && f.at<uint64_t>(72) == 0, "no global data");
  f.require(dfd_at == 80 + 24 * size_t{file.levels}, "the descriptor follows the level index");
  f.require(kvd_at == dfd_at + dfd_length, "key/value data follows the descriptor");
  if (!f.problem().empty()) return file.problem = f.problem(), file;
  ktx::check_descriptor(f, dfd_at, dfd_length, channel_bytes, file);
  ktx::read_key_values(f, kvd_at, kvd_length, file);

  const size_t alignment = std::lcm(size_t{4} * channel_bytes, size_t{4});
  size_t end = kvd_at + kvd_length;
  file.images.resize(file.levels);
  for (size_t i = file.levels; i-- > 0 && f.problem().empty();) {
    KtxFile::Level& level = file.images[i];
    level.side = std::max(1U, file.side >> i);
    const size_t entry = 80 + 24 * i;
    const auto at = size_t(f.at<uint64_t>(entry)), length = size_t(f.at<uint64_t>(entry + 8));
    f.require(f.at<uint64_t>(entry + 16) == length, "uncompressed length");
    f.require(length == size_t{6} * level.side * level.side * 4 * channel_bytes, "level's length");
    f.require(at == (end + alignment - 1) / alignment * alignment,
              "levels lie from the smallest to the largest, aligned");
    if (!f.problem().empty()) break;
    for (; end < at; ++end) f.require(f.at<uint8_t>(end) == 0, "padding is zero");
    end = at + length;
    if (end > f.size()) {
      f.require(false, "the file ends too soon");
      break;
    }
    level.rgba.resize(length / channel_bytes);
    for (size_t k = 0; k < level.rgba.size(); ++k)
      level.rgba[k] = channel_bytes == 2 ? ktx::half_value(f.at<uint16_t>(at + 2 * k))
                                         : f.at<float>(at + 4 * k);
  }
  f.require(f.problem().empty() && end == f.size(), "nothing follows the last level");
  file.problem = f.problem();
  return file;
}

}  // namespace skylapse::output
