#include "diff/shrink.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skylapse::diff {
namespace {

/// As image::OddSamples counts them.
constexpr float kNegativeShare = 1e-3f;

int rounded_up(int size, int factor) { return (size + factor - 1) / factor; }

/// One sample of the small picture.
class Sum {
 public:
  void add(float value, float strongest) {
    if (std::isnan(value))
      nan_ = true;
    else if (std::isinf(value))
      infinite_ = value;
    else if (value < 0 && value < -kNegativeShare * strongest)
      lowest_ = std::min(lowest_, value);
    else
      sum_ += value, ++count_;
  }
  [[nodiscard]] float mean() const {
    if (nan_) return std::numeric_limits<float>::quiet_NaN();
    if (infinite_ != 0) return infinite_;
    if (lowest_ < 0) return lowest_;
    return count_ > 0 ? float(sum_ / count_) : 0.0f;
  }

 private:
  double sum_ = 0;
  int count_ = 0;
  bool nan_ = false;
  float infinite_ = 0, lowest_ = 0;
};

float strongest_of(const float* pixel, int channels) {
  float strongest = 0;
  for (int c = 0; c < channels; ++c)
    if (std::isfinite(pixel[c])) strongest = std::max(strongest, std::abs(pixel[c]));
  return strongest;
}

}  // namespace

int shrink_factor(int width, int height, int max_width) {
  int factor = 1;
  const auto too_large = [&](int f) {
    const double w = rounded_up(width, f), h = rounded_up(height, f);
    return w > max_width || w * h > double(max_width) * max_width;
  };
  while (too_large(factor)) ++factor;
  return factor;
}

image::Picture shrunk(const image::Picture& picture, int factor, int channels) {
  image::Picture small;
  small.width = rounded_up(picture.width, factor);
  small.height = rounded_up(picture.height, factor);
  small.channels.assign(picture.channels.begin(), picture.channels.begin() + channels);
  small.storage = picture.storage, small.display_referred = picture.display_referred;
  small.samples.reserve(small.pixel_count() * channels);
  std::vector<Sum> sums;
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      sums.assign(channels, {});
      for (int v = y * factor; v < std::min(picture.height, (y + 1) * factor); ++v)
        for (int u = x * factor; u < std::min(picture.width, (x + 1) * factor); ++u) {
          const float* pixel = picture.pixel(u, v);
          const float strongest = strongest_of(pixel, picture.colour_count());
          for (int c = 0; c < channels; ++c) sums[c].add(pixel[c], strongest);
        }
      for (const Sum& sum : sums) small.samples.push_back(sum.mean());
    }
  return small;
}

std::vector<float> shrunk_by_largest(std::span<const float> values, int width, int height,
                                     int factor) {
  const int w = rounded_up(width, factor), h = rounded_up(height, factor);
  std::vector<float> small(size_t(w) * size_t(h), 0.0f);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float value = values[size_t(y) * size_t(width) + size_t(x)];
      float& kept = small[size_t(y / factor) * size_t(w) + size_t(x / factor)];
      if (std::isnan(value) || std::abs(value) > std::abs(kept)) kept = value;
    }
  return small;
}

}  // namespace skylapse::diff
