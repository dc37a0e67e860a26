#include "output/imageio/decode.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <utility>

#include "output/imageio/read.h"

namespace skylapse::output::imageio {
namespace {

/// Of what this program may have written: the largest picture of a job has 2^30 pixels.
constexpr ReadLimits kOwnFiles{
    .pixels = 1ull << 30, .bytes = std::numeric_limits<uint64_t>::max(), .channels = 1024};

/// Channel numbers of red, green and blue.
std::array<size_t, 3> rgb_channels(const std::vector<std::string>& channels) {
  if (channels.size() < 3) return {0, 0, 0};
  const auto number_of = [&](std::string_view name) {
    return size_t(std::find(channels.begin(), channels.end(), name) - channels.begin());
  };
  const std::array<size_t, 3> rgb{number_of("R"), number_of("G"), number_of("B")};
  const bool named = std::ranges::all_of(rgb, [&](size_t c) { return c < channels.size(); });
  return named ? rgb : std::array<size_t, 3>{0, 1, 2};
}

}  // namespace

Result<DecodedImage> decode(const std::string& path) {
  auto read_image = read(path, 0, kOwnFiles);
  if (!read_image) return read_image.error();
  ReadImage file = std::move(*read_image);
  const auto rgb = rgb_channels(file.channels);
  const size_t count = file.channels.size();
  DecodedImage image;
  if (count == 3 && rgb == std::array<size_t, 3>{0, 1, 2}) {
    image.pixels = image::FrameBuffer(file.width, file.height, std::move(file.samples));
  } else {
    image.pixels = image::FrameBuffer(file.width, file.height);
    for (size_t i = 0; i < image.pixels.pixel_count(); ++i)
      for (size_t c = 0; c < 3; ++c)
        image.pixels.data()[3 * i + c] = file.samples[count * i + rgb[c]];
  }
  image.attributes = std::move(file.attributes);
  const image::SampleStorage& stored = file.storage[rgb[0]];
  image.floating_point = stored.kind != image::SampleStorage::Kind::integer;
  image.stored_bits = stored.bits;
  return image;
}

}  // namespace skylapse::output::imageio
