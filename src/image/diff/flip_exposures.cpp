#include "image/diff/flip_exposures.h"

#include <algorithm>
#include <cmath>

#include "image/diff/float_histogram.h"

namespace skylapse::image::flip_internal {
namespace {

/// Display value that the ends of the exposures are made for (Andersson et al. 2021, section 3).
constexpr double kBrightTone = 0.85;

/// Powers of two that floats can be scaled by.
constexpr double kLargestStop = 126;

// The plan of our own, see flip.h.
constexpr double kBrightShare = 0.99, kDarkShare = 0.1;
constexpr double kStopsAboveBright = 2;
constexpr double kStopsBelowBright = 10;
constexpr double kStopsApart = 2.4;

/// Where the curve reaches kBrightTone: the larger root.
double bright_input(const RationalCurve& c) {
  const double square = c.k0 - kBrightTone * c.k3, linear = c.k1 - kBrightTone * c.k4,
               constant = -kBrightTone * c.k5;
  if (square == 0) return -constant / linear;
  const double root = std::sqrt(linear * linear - 4 * square * constant);
  return std::max((-linear + root) / (2 * square), (-linear - root) / (2 * square));
}

FloatRows luminances(const Picture& picture) {
  return {picture.width, picture.height, [&picture](int y, float* buffer) -> const float* {
            const int channels = picture.channel_count();
            const int second = picture.colour_count() == 3 ? 1 : 0, third = 2 * second;
            const float* p = picture.pixel(0, y);
            for (int x = 0; x < picture.width; ++x, p += channels)
              buffer[x] = std::min(0.2126f * light_of(p[0]) + 0.7152f * light_of(p[second]) +
                                       0.0722f * light_of(p[third]),
                                   0x1.fffffep127f);
            return buffer;
          }};
}

/// Of the positive luminances of a picture.
struct Spread {
  double median = 0, maximum = 0;
  uint64_t count = 0;
};

float exact_value(const FloatRows& rows, const FloatHistogram& histogram, uint64_t rank) {
  const int bin = histogram.bin_of_rank(rank);
  uint64_t below = 0;
  for (int i = 0; i < bin; ++i) below += histogram.count_of(i);
  const auto counts = counts_within(rows, bin);
  size_t low = 0;
  while (below + counts[low] <= rank) below += counts[low++];
  return value_within(bin, low);
}

Spread spread_of(const Picture& picture) {
  const FloatRows rows = luminances(picture);
  const FloatHistogram histogram = histogram_of(rows);
  const uint64_t all = histogram.count(), black = histogram.count_of(0);
  if (black == all) return {};
  Spread spread;
  spread.count = all - black;
  spread.maximum = exact_value(rows, histogram, all - 1);
  // The median of all if that is not black: the paper's.
  const uint64_t middle = all / 2;
  spread.median = exact_value(rows, histogram, middle >= black ? middle : black + spread.count / 2);
  return spread;
}

/// Ends as planned, before any that the caller gives; nothing: no light.
struct Ends {
  double start = 0, stop = 0;
};

std::optional<Ends> published_ends(const Picture& reference, const Picture& test, double bright) {
  Spread spread = spread_of(reference);
  if (spread.count == 0) spread = spread_of(test);
  if (spread.count == 0) return std::nullopt;
  return Ends{std::log2(bright / spread.maximum), std::log2(bright / spread.median)};
}

/// Value at a share of the positive luminances not below bin `first`, to 1/128.
double percentile(const FloatHistogram& histogram, int first, double share) {
  uint64_t below = 0;
  for (int bin = 0; bin < first; ++bin) below += histogram.count_of(bin);
  const uint64_t count = histogram.count() - below;
  const auto rank = std::min(count - 1, uint64_t(share * double(count)));
  return FloatHistogram::lower_bound(histogram.bin_of_rank(below + rank));
}

std::optional<Ends> planned_ends(const Picture& reference, const Picture& test, double bright) {
  FloatHistogram histogram = histogram_of(luminances(reference));
  histogram.add(histogram_of(luminances(test)));
  if (histogram.count_of(0) == histogram.count()) return std::nullopt;
  const double bright_light = percentile(histogram, 1, kBrightShare);
  const int faintest = FloatHistogram::bin_of(float(bright_light * std::exp2(-kStopsBelowBright)));
  const double dark_light = percentile(histogram, std::max(faintest, 1), kDarkShare);
  return Ends{std::log2(bright / bright_light) - kStopsAboveBright, std::log2(bright / dark_light)};
}

int planned_count(const FlipOptions& options, double range) {
  if (options.exposures) return std::max(1, *options.exposures);
  if (options.published_exposures) return std::max(2, int(std::ceil(range)));
  constexpr double kRounding = 1e-9;  // of logarithms: 12 stops are five steps
  return 1 + int(std::ceil(range / kStopsApart - kRounding));
}

}  // namespace

RationalCurve curve_of(ToneMapper mapper) {
  switch (mapper) {
    case ToneMapper::hable:
      return {0.231683f, 0.013791f, 0.18f, 0.3f, 0.018f, 1e3f};
    case ToneMapper::reinhard:
      return {0, 1, 0, 1, 1, 1e15f};
    case ToneMapper::aces:
      break;
  }
  // Narkowicz 2015, with the factor 0.6 before it.
  return {0.9036f, 0.018f, 0.8748f, 0.354f, 0.14f, 1e3f};
}

ExposurePlan plan_exposures(const Picture& reference, const Picture& test,
                            const FlipOptions& options) {
  Ends ends;
  if (!options.start || !options.stop) {
    const double bright = bright_input(curve_of(options.tone_mapper));
    const auto planned = options.published_exposures ? published_ends(reference, test, bright)
                                                     : planned_ends(reference, test, bright);
    if (!planned) return {};
    ends = *planned;
  }
  ends.start = std::clamp(options.start.value_or(ends.start), -kLargestStop, kLargestStop);
  ends.stop = std::clamp(options.stop.value_or(ends.stop), -kLargestStop, kLargestStop);
  if (ends.start > ends.stop) std::swap(ends.start, ends.stop);
  ExposurePlan plan{ends.start, ends.stop, planned_count(options, ends.stop - ends.start)};
  if (plan.count == 1) plan.stop = plan.start;
  return plan;
}

}  // namespace skylapse::image::flip_internal
