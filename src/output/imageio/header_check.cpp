#include "output/imageio/header_check.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <optional>
#include <utility>

namespace skylapse::output::imageio {
namespace {

constexpr const char* kCut = "the file ends early";

/// Numbers at places of a file; nothing beyond its end.
class FileBytes {
 public:
  explicit FileBytes(const std::string& path) : in_(path, std::ios::binary | std::ios::ate) {
    size_ = in_ ? uint64_t(std::max<std::streamoff>(in_.tellg(), 0)) : 0;
  }
  [[nodiscard]] uint64_t size() const { return size_; }

  template <size_t N>
  std::optional<std::array<unsigned char, N>> bytes(uint64_t at) {
    std::array<unsigned char, N> out{};
    if (at + N > size_) return std::nullopt;
    in_.seekg(std::streamoff(at));
    if (!in_.read(reinterpret_cast<char*>(out.data()), N)) return std::nullopt;
    return out;
  }
  std::optional<uint32_t> little(uint64_t at) {
    const auto b = bytes<4>(at);
    if (!b) return std::nullopt;
    return uint32_t((*b)[0]) | uint32_t((*b)[1]) << 8 | uint32_t((*b)[2]) << 16 |
           uint32_t((*b)[3]) << 24;
  }
  std::optional<uint32_t> big(uint64_t at) {
    const auto v = little(at);
    if (!v) return std::nullopt;
    return __builtin_bswap32(*v);
  }
  /// Up to the NUL that ends it, which lies within `most` bytes; `at` moves behind it.
  std::optional<std::string> text(uint64_t& at, size_t most) {
    std::string out;
    in_.clear();
    in_.seekg(std::streamoff(at));
    for (int c = in_.get(); c > 0; c = in_.get()) {
      if (out.size() == most) return std::nullopt;
      out += char(c);
    }
    at += out.size() + 1;
    return at > size_ ? std::nullopt : std::optional(out);
  }

 private:
  std::ifstream in_;
  uint64_t size_ = 0;
};

/// Attributes of one part that say how much there is to allocate.
struct ExrHeader {
  std::optional<std::array<int32_t, 4>> data_window, display_window;  // x0 y0 x1 y1
  std::array<uint32_t, 2> tile{1, 1};
  bool empty = true;  // the end of the list of parts
};

constexpr size_t kMostName = 255;

Result<ExrHeader, std::string> read_exr_header(FileBytes& file, uint64_t& at) {
  ExrHeader header;
  while (true) {
    const auto name = file.text(at, kMostName);
    if (!name) return std::string("its header is damaged");
    if (name->empty()) return header;
    header.empty = false;
    const auto type = file.text(at, kMostName);
    const auto size = file.little(at);
    if (!type || !size || *size > file.size() || at + 4 + *size > file.size())
      return std::string("its header is damaged at \"" + *name + "\"");
    at += 4;
    if ((*name == "dataWindow" || *name == "displayWindow") && *size == 16) {
      std::array<int32_t, 4> window{};
      for (size_t i = 0; i < 4; ++i) window[i] = int32_t(*file.little(at + 4 * i));
      (*name == "dataWindow" ? header.data_window : header.display_window) = window;
    }
    if (*name == "tiles" && *size == 9) header.tile = {*file.little(at), *file.little(at + 4)};
    at += *size;
  }
}

std::string too_large(int64_t width, int64_t height, const ReadLimits& limits) {
  return std::to_string(width) + " x " + std::to_string(height) +
         " pixels are more than is read (" + std::to_string(limits.pixels) + ")";
}

std::string window_problem(const std::array<int32_t, 4>& w, const ReadLimits& limits) {
  const int64_t width = int64_t{w[2]} - w[0] + 1, height = int64_t{w[3]} - w[1] + 1;
  if (width <= 0 || height <= 0) return "it holds no pixels";
  // Both are below 2^33: no product of doubles is wrong by more than its last digit.
  if (double(width) * double(height) <= double(limits.pixels)) return {};
  return too_large(width, height, limits);
}

std::string exr_problem(FileBytes& file, const ReadLimits& limits) {
  const auto version = file.little(4);
  if (!version) return kCut;
  constexpr uint32_t kMultiPart = 0x1000;
  constexpr int kMostParts = 1024;
  uint64_t at = 8;
  for (int part = 0; part < kMostParts; ++part) {
    const auto header = read_exr_header(file, at);
    if (!header) return header.error();
    if (header->empty && part > 0) return {};
    if (!header->data_window || !header->display_window) return "its header lacks its windows";
    for (const auto& window : {*header->data_window, *header->display_window})
      if (std::string why = window_problem(window, limits); !why.empty()) return why;
    const auto [tile_width, tile_height] = header->tile;
    if (double(tile_width) * double(tile_height) > double(limits.pixels))
      return "its tiles are larger than any picture that is read";
    if ((*version & kMultiPart) == 0) return {};
  }
  return "it has more than " + std::to_string(kMostParts) + " parts";
}

/// A PNG is a chain of chunks up to IEND.
std::string png_problem(FileBytes& file, const ReadLimits& limits) {
  const auto width = file.big(16), height = file.big(20);
  if (!width || !height) return kCut;
  if (double(*width) * double(*height) > double(limits.pixels))
    return too_large(*width, *height, limits);
  for (uint64_t at = 8;;) {
    const auto length = file.big(at);
    const auto type = file.bytes<4>(at + 4);
    if (!length || !type) return kCut;
    at += uint64_t{12} + *length;  // length, type and checksum
    if (at > file.size()) return kCut;
    if (std::memcmp(type->data(), "IEND", 4) == 0) return {};
  }
}

/// SMPTE 268M: places in the header of what tells the size of the file and of its first element.
/// There must be at least the bits of the samples, unless they are run lengths.
std::string dpx_problem(FileBytes& file, const ReadLimits& limits) {
  constexpr uint64_t kFileSize = 16, kUserSize = 32, kWidth = 772, kHeight = 776, kElement = 780;
  constexpr uint32_t kNotSaid = 0xFFFFFFFF;
  const bool swapped = file.little(0) == 0x53445058U;  // "XPDS"
  const auto word = [&](uint64_t at) { return swapped ? file.little(at) : file.big(at); };
  const auto total = word(kFileSize), width = word(kWidth), height = word(kHeight);
  const auto kind = file.bytes<4>(kElement + 20);    // descriptor, transfer, colorimetry, bits
  const auto coding = file.bytes<4>(kElement + 24);  // packing, encoding
  const auto begin = word(kElement + 28);
  if (!total || !width || !height || !kind || !coding || !begin) return kCut;
  if (*total != kNotSaid && *total > file.size()) return kCut;
  const auto user = word(kUserSize);
  if (user && *user != kNotSaid && *user > file.size()) return kCut;
  if (double(*width) * double(*height) > double(limits.pixels))
    return too_large(*width, *height, limits);
  const unsigned descriptor = (*kind)[0], bits = (*kind)[3];
  const unsigned samples = descriptor == 50 ? 3 : descriptor == 51 || descriptor == 52 ? 4 : 1;
  const double needed = double(*width) * double(*height) * samples * bits / 8;
  const bool run_lengths = (*coding)[swapped ? 2 : 3] != 0;
  const double from = *begin == kNotSaid ? 0 : double(*begin);
  return !run_lengths && from + needed > double(file.size()) ? kCut : "";
}

}  // namespace

std::string header_problem(const std::string& path, const std::string& format,
                           const ReadLimits& limits) {
  FileBytes file(path);
  if (format == "openexr") return exr_problem(file, limits);
  if (format == "png") return png_problem(file, limits);
  if (format == "dpx") return dpx_problem(file, limits);
  return {};
}

}  // namespace skylapse::output::imageio
