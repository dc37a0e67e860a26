#pragma once
// The filters of FLIP as taps of separable kernels (Andersson et al. 2020, sections 4.1 and 4.2).
#include <vector>

namespace skylapse::image::flip_internal {

/// Taps of one dimension for offsets 0..radius; the other side is the same (even) or its negative
/// (odd).
struct Taps {
  std::vector<float> weight;
  [[nodiscard]] int radius() const { return int(weight.size()) - 1; }
};

/// Even kernels but `edge`. Those of luminance and of both chromatic channels sum to 1 in two
/// dimensions; the blue-yellow channel is the sum of two separable kernels, whose shares are in
/// the taps of the second (vertical) pass.
struct Filters {
  Taps luminance, red_green;
  Taps blue_yellow[2], blue_yellow_weighted[2];
  /// Of luminance features: smoothing (sums to 1), first derivative (odd), second derivative, of
  /// which the positive and the negative taps sum to 1 and -1.
  Taps smooth, edge, point;
  int radius = 0;  // the largest of them
};

/// Kernels cut off as the paper says, at three standard deviations of the widest, and further where
/// taps fall below 1e-10 of the whole. Domain: pixels_per_degree in (0, 1000].
Filters filters_for(double pixels_per_degree);

}  // namespace skylapse::image::flip_internal
