#pragma once
// The pass over the pixels: sums that every measure is made from.
#include <array>
#include <cstdint>
#include <vector>

#include "image/diff/error_histogram.h"
#include "image/diff/error_scale.h"
#include "image/diff/measure.h"
#include "image/diff/sky_rows.h"

namespace skylapse::image {

/// Side of the blocks whose errors are judged together, in pixels.
inline constexpr int kErrorBlock = 8;

/// Of the pixels of a region, or of all.
struct PixelSums {
  double count = 0;
  double squares = 0;                            // of the pixels' errors
  std::array<double, 3> signed_sum{};            // of the colour channels' errors, signs kept
  std::array<double, 3> rounding_squares{};      // of what rounding in RGBE files is in those
  std::array<double, 3> colour_a{}, colour_b{};  // of the colours, by solid angle where it is known
  double light_weight = 0;                       // of those sums
  double worst = -1;
  PixelPlace worst_at;
  void add(const PixelSums& other);
};

/// The group of pixels (block, row, column) with the largest root mean square.
struct WorstGroup {
  double mean_square = -1;
  PixelPlace at;  // its worst pixel, or its first
  void offer(double mean_square, PixelPlace place) {
    if (mean_square > this->mean_square) *this = {mean_square, place};
  }
};

/// Light of the sphere for irradiance and harmonics.
struct SkyLight {
  std::array<double, 3> horizontal{};  // sum of L Omega sin(elevation) above the level
  std::array<double, 9> harmonics{};   // of the mean of the colour channels
};

struct ErrorSums {
  OddSamples odd;
  bool identical = true;
  PixelSums all;
  std::array<PixelSums, kSkyRegions> regions;
  ErrorHistogram histogram;
  WorstGroup block, row, column;
  double solid_angle = 0, weighted_squares = 0;
  double absolute_sum = 0, absolute_squares = 0, absolute_max = -1;
  double limited_squares = 0;  // of values limited to 0 .. ErrorScale::peak
  PixelPlace absolute_at;
  uint64_t samples = 0;   // colour samples that are numbers in both
  double other_max = -1;  // largest error of channels that are no colours
  PixelPlace other_at;
  SkyLight light, change;  // of a, and of b less a
  std::vector<double> column_squares;
};

/// `error` takes one value a pixel. Sums do not depend on the number of threads.
ErrorSums sum_errors(const Picture& a, const Picture& b, const ErrorScale& scale,
                     const SkyView& view, std::vector<float>& error);

}  // namespace skylapse::image
