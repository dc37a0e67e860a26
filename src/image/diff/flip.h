#pragma once
// FLIP and HDR-FLIP: how different two pictures look to somebody who flips between them.
#include <optional>
#include <vector>

#include "core/result.h"
#include "image/diff/picture.h"

namespace skylapse::image {

enum class ToneMapper { aces, hable, reinhard };

/// 0.7 m from a 0.7 m wide display of 3840 pixels.
inline constexpr double kFlipPixelsPerDegree = 67.0206432765823;

struct FlipOptions {
  double pixels_per_degree = kFlipPixelsPerDegree;
  // Of scene-linear pictures alone:
  ToneMapper tone_mapper = ToneMapper::aces;
  std::optional<double> start, stop;  // exposures in stops; nothing: planned
  std::optional<int> exposures;
  bool published_exposures =
      false;  // plan as the paper does (from the reference's maximum and median)
};

/// The pooled values of a map.
struct FlipResult {
  double mean = 0, maximum = 0, minimum = 0;
  double weighted_quartile_1 = 0, weighted_median = 0, weighted_quartile_3 = 0;
  int max_x = 0, max_y = 0;
  double start = 0, stop = 0;  // of scene-linear pictures
  int exposures = 0;           // 0: of display pictures, and where there is no light to expose for
  std::vector<float> map;      // one value a pixel, row by row
};

/// `reference` and `test` have one size (asserted) and finite samples (NaN and Inf are to be found
/// before; here they count as black and as the largest float). Display pictures: LDR-FLIP; others:
/// HDR-FLIP. Grey pictures count as three equal channels, channels beyond the colours play no part.
FlipResult flip(const Picture& reference, const Picture& test, const FlipOptions& options = {});

}  // namespace skylapse::image
