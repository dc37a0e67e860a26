#pragma once
// One number for a map of errors, and others (Andersson et al. 2021, Ray Tracing Gems II, ch. 19).
#include "image/diff/flip.h"

namespace skylapse::image::flip_internal {

/// Fills the pooled values of a result from its map. The mean is summed exactly; a weighted
/// percentile is the first value of the ascending list at which the running sum exceeds that share
/// of the total, 0 if the total is.
void pool(int width, int height, FlipResult& result);

}  // namespace skylapse::image::flip_internal
