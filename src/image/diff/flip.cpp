#include "image/diff/flip.h"

#include <cassert>
#include <cmath>

#include "core/parallel.h"
#include "image/diff/flip_exposures.h"
#include "image/diff/flip_pool.h"
#include "image/diff/flip_tiles.h"

namespace skylapse::image {
namespace {

using namespace flip_internal;

/// 0 where the colours are equal, 1 where not.
void compare_exactly(const Picture& a, const Picture& b, std::vector<float>& map) {
  const auto colours_a = size_t(a.colour_count()), colours_b = size_t(b.colour_count());
  const auto channels_a = size_t(a.channel_count()), channels_b = size_t(b.channel_count());
  map.assign(a.pixel_count(), 0);
  parallel_for_ranges(map.size(), 65536, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      for (size_t c = 0; c < 3; ++c) {
        const float va = a.samples[i * channels_a + c % colours_a];
        const float vb = b.samples[i * channels_b + c % colours_b];
        if (va != vb && !(std::isnan(va) && std::isnan(vb))) map[i] = 1;
      }
  });
}

}  // namespace

FlipResult flip(const Picture& reference, const Picture& test, const FlipOptions& options) {
  return flip_with(best_kernels(), reference, test, options);
}

FlipResult flip_internal::flip_with(const Kernels& kernels, const Picture& reference,
                                    const Picture& test, const FlipOptions& options) {
  assert(reference.width == test.width && reference.height == test.height);
  FlipResult result;
  if (reference.pixel_count() == 0) return result;
  const bool display = reference.display_referred;
  FlipJob job{reference,           test, kernels, filters_for(options.pixels_per_degree),
              options.tone_mapper, {}};
  if (!display) {
    const ExposurePlan plan = plan_exposures(reference, test, options);
    result.start = plan.start;
    result.stop = plan.stop;
    result.exposures = plan.count;
    for (int i = 0; i < plan.count; ++i) job.scales.push_back(float(std::exp2(plan.exposure(i))));
  }
  if (display || result.exposures > 0)
    fill_map(job, result.map);
  else
    compare_exactly(reference, test, result.map);
  pool(reference.width, reference.height, result);
  return result;
}

}  // namespace skylapse::image
