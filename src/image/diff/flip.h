#pragma once
// FLIP and HDR-FLIP: how different two pictures look to somebody who flips between them.
//
// Sources: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020, FLIP: A
// Difference Evaluator for Alternating Images, doi 10.1145/3406183; Andersson, Nilsson, Shirley,
// Akenine-Möller 2021, Visualizing Errors in Rendered High Dynamic Range Images. Where they leave
// a choice, that of their program is made (NVlabs/flip 1.6). Within 1e-4 of its answers (tested).
//
// Changed: the pictures are filtered as their mean and their difference instead of one by one, so
// that rounding is not magnified where they nearly agree. Every machine, instruction set and number
// of threads gives the same bits. Equal surroundings (10 pixels at the default distance) give
// exactly 0, and with given exposures exchanging the pictures changes nothing.
//
// It joins the other measures and replaces none: the eye hardly sees fine noise, and nothing of a
// disc that is white at every exposure.
#include <optional>
#include <vector>

#include "core/result.h"
#include "image/diff/picture.h"

namespace skylapse::image {

enum class ToneMapper { aces, hable, reinhard };

/// 0.7 m from a 0.7 m wide display of 3840 pixels.
inline constexpr double kFlipPixelsPerDegree = 67.0206432765823;

/// Exposures of scene-linear pictures are multiplications by powers of two ("stops") before the
/// tone mapping; E is the largest over all of them. x is the input that the tone mapper makes 0.85.
///
/// Planned by default, alike for both pictures, from luminances that either has (black, negative
/// and subnormal ones left out): bright = 99 % of them are below, dark = 10 % of those that are not
/// 10 stops under `bright` are below. The first exposure shows 4 bright as 0.85, the last shows
/// dark so, with steps of at most 2.4 stops: 2 to 6 exposures. Thus 1 % of the pixels may be a disc
/// of any strength, and any number black, without a say; what lies up to 4.5 stops above `bright`
/// is still told apart from white; and from one exposure to the next a tone falls from 0.85 to no
/// less than 0.36, where the curve is steep.
///
/// As published: from x / maximum to x / median of the reference, in max(2, ceil(stop - start))
/// exposures: many of them for a sun (12 and more), and the order of the pictures matters. Where
/// that has no answer ours is: the median is that of positive luminances if more than half is
/// black, and a black reference is exposed as the test is.
///
/// No positive luminance in either picture, and an end to be planned: no exposures, and pixels are
/// compared exactly, 0 where the samples are equal (NaN is NaN), 1 where not.
struct FlipOptions {
  /// In (0, 1000], asserted. All filters scale with it.
  double pixels_per_degree = kFlipPixelsPerDegree;
  // Of scene-linear pictures alone:
  ToneMapper tone_mapper = ToneMapper::aces;
  /// Stops, held to [-126, 126]; nothing: planned. The lower of both is the first.
  std::optional<double> start, stop;
  /// 1: `start` alone, less than that counts as 1; nothing: planned.
  std::optional<int> exposures;
  bool published_exposures = false;
};

/// The map of errors, 0..1, and its pooled values.
struct FlipResult {
  double mean = 0, maximum = 0, minimum = 0;
  /// Below it lies that share of the sum of all errors; 0 if there are none.
  double weighted_quartile_1 = 0, weighted_median = 0, weighted_quartile_3 = 0;
  int max_x = 0, max_y = 0;    // the first pixel, row by row, that has the maximum
  double start = 0, stop = 0;  // of scene-linear pictures, the first and the last exposure
  int exposures = 0;           // 0: of display pictures, and where there is no light to expose for
  std::vector<float> map;      // one value a pixel, row by row
};

/// Pictures of one size (asserted), down to one pixel: beyond the border its pixels are repeated,
/// also across the seam of a lat-long map. Display pictures (the reference says whether): sRGB code
/// values, held to 0..1, LDR-FLIP. Others: HDR-FLIP of linear light.
///
/// All samples have an answer, though NaN and Inf are to be found before: NaN, negative and
/// subnormal numbers count as black, Inf as the largest float. Light that any exposure makes
/// brighter than 1000 times white (Reinhard: 1e15) counts as that, which is white in either case.
///
/// Grey pictures count as three equal channels, channels beyond the colours play no part. A thread
/// needs a few MB, however large the pictures are.
FlipResult flip(const Picture& reference, const Picture& test, const FlipOptions& options = {});

}  // namespace skylapse::image
