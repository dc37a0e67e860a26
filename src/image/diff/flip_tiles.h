#pragma once
// FLIP piece by piece: each tile of the map with what it needs of the pictures around it.
#include <vector>

#include "image/diff/flip.h"
#include "image/diff/flip_exposures.h"
#include "image/diff/flip_filters.h"
#include "image/diff/flip_kernels.h"

namespace skylapse::image::flip_internal {

/// What all tiles share.
struct FlipJob {
  const Picture& first;
  const Picture& second;
  const Kernels& kernels;
  Filters filters;
  ToneMapper tone_mapper = ToneMapper::aces;
  std::vector<float> scales;  // of the exposures; of display pictures: none
};

/// Fills `map`, one value a pixel. The result does not depend on the number of threads.
void fill_map(const FlipJob& job, std::vector<float>& map);

/// flip() with the loops of a chosen instruction set.
FlipResult flip_with(const Kernels& kernels, const Picture& reference, const Picture& test,
                     const FlipOptions& options);

}  // namespace skylapse::image::flip_internal
