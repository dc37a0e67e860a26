#include "image/diff/error_scale.h"

#include <algorithm>
#include <cmath>

namespace skylapse::image {
namespace {

constexpr size_t kSampled = size_t{1} << 16;

/// Strongest magnitude of the channels [first, first + count) of a pixel; 0 if that is no number.
float strength(const float* pixel, int first, int count) {
  float m = 0;
  for (int c = first; c < first + count; ++c) m = std::max(m, std::fabs(pixel[c]));
  return std::isfinite(m) ? m : 0;
}

void collect(const Picture& picture, size_t step, int first, int count, std::vector<float>& out) {
  const auto channels = size_t(picture.channel_count());
  for (size_t i = 0; i < picture.pixel_count(); i += step)
    if (const float m = strength(picture.samples.data() + i * channels, first, count); m > 0)
      out.push_back(m);
}

/// kDarkShare of the median of what both pictures hold that is not zero.
float floor_of(const Picture& a, const Picture& b, int first, int count) {
  // An odd step does not fall into step with columns.
  const size_t step = std::max<size_t>(1, a.pixel_count() / kSampled) | 1;
  std::vector<float> light;
  for (const size_t every : {step, size_t{1}}) {
    collect(a, every, first, count, light);
    collect(b, every, first, count, light);
    if (!light.empty()) break;  // else a few stars may lie between the sampled pixels
  }
  if (light.empty()) return float(kDarkest);
  const auto middle = light.begin() + std::ptrdiff_t(light.size() / 2);
  std::nth_element(light.begin(), middle, light.end());
  return std::max(float(kDarkest), float(kDarkShare * double(*middle)));
}

/// Two files of one kind may round to neighbours; a file rounded from another is half a step off.
float steps(SampleStorage::Kind kind, const Picture& a, const Picture& b) {
  const int coarse = int(a.storage.kind == kind) + int(b.storage.kind == kind);
  return 0.5F * float(coarse);
}

}  // namespace

ErrorScale error_scale(const Picture& a, const Picture& b) {
  ErrorScale scale;
  scale.display = a.display_referred;
  scale.colours = a.colour_count();
  if (!scale.display) scale.floor = floor_of(a, b, 0, scale.colours);
  for (int c = scale.colours; c < a.channel_count(); ++c)
    scale.others.push_back(scale.display ? 0 : floor_of(a, b, c, 1));
  using enum SampleStorage::Kind;
  scale.rgbe_step = steps(rgbe, a, b);
  scale.half_step = std::ldexp(steps(half_float, a, b), -10);  // of the next power of two below
  // Below 2^-14 halves are evenly spaced. What a float loses there it loses for good, and counts;
  // two halves may be neighbours.
  if (a.storage.kind == half_float && b.storage.kind == half_float)
    scale.absolute_step = std::ldexp(1.0F, -24);
  // One quantum of a transform's coefficient is worth a few code values in each of its pixels.
  if (scale.display && a.storage.lossy && b.storage.lossy) scale.absolute_step = 4.0F / 255.0F;
  return scale;
}

}  // namespace skylapse::image
