#include "image/diff/flip_pool.h"

#include <algorithm>

#include "image/diff/float_histogram.h"

namespace skylapse::image::flip_internal {
namespace {

double weighted_percentile(const FloatRows& rows, const FloatHistogram& histogram, double share) {
  const double target = share * histogram.sum();
  double below = 0;
  for (int bin = 0; bin < FloatHistogram::kBins; ++bin) {
    const double here = histogram.sum_of(bin);
    if (below + here <= target) {
      below += here;
      continue;
    }
    const auto counts = counts_within(rows, bin);
    double value = 0;
    for (size_t low = 0; low < counts.size(); ++low) {
      if (counts[low] == 0) continue;
      value = value_within(bin, low);
      below += value * double(counts[low]);
      if (below > target) break;
    }
    return value;
  }
  return 0;
}

}  // namespace

void pool(int width, int height, FlipResult& result) {
  const auto& map = result.map;
  const FloatRows rows{width, height,
                       [&](int y, float*) { return map.data() + size_t(y) * size_t(width); }};
  const FloatHistogram histogram = histogram_of(rows);
  result.mean = histogram.sum() / double(map.size());
  result.weighted_quartile_1 = weighted_percentile(rows, histogram, 0.25);
  result.weighted_median = weighted_percentile(rows, histogram, 0.5);
  result.weighted_quartile_3 = weighted_percentile(rows, histogram, 0.75);
  const auto [least, most] = std::minmax_element(map.begin(), map.end());
  const auto first_most = std::find(map.begin(), map.end(), *most);
  const auto place = first_most - map.begin();
  result.minimum = *least;
  result.maximum = *most;
  result.max_x = int(place % width);
  result.max_y = int(place / width);
}

}  // namespace skylapse::image::flip_internal
