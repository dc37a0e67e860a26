#pragma once
// At which exposures HDR-FLIP looks.
#include "image/diff/flip.h"
#include "image/diff/flip_kernels.h"

namespace skylapse::image::flip_internal {

/// Light of one sample: NaN, negative and subnormal numbers are black, Inf is the largest float.
inline float light_of(float sample) {
  constexpr float kSmallest = 0x1p-126f, kLargest = 0x1.fffffep127f;
  const float positive = sample >= kSmallest ? sample : 0.0f;  // NaN is not
  return positive < kLargest ? positive : kLargest;
}

/// `count` exposures from start to stop, in stops; 0: there is no light to expose for.
struct ExposurePlan {
  double start = 0, stop = 0;
  int count = 0;
  [[nodiscard]] double exposure(int i) const {
    return count > 1 ? start + (stop - start) * i / (count - 1) : start;
  }
};

/// As flip.h says.
ExposurePlan plan_exposures(const Picture& reference, const Picture& test,
                            const FlipOptions& options);

/// Coefficients of ACES' and Hable's curves; of Reinhard's, k1 / (k4 x + k5), for its equations.
RationalCurve curve_of(ToneMapper mapper);

}  // namespace skylapse::image::flip_internal
