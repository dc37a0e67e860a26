#pragma once
// What the difference of two samples is measured by (measure.h says why).
#include <vector>

#include "image/diff/picture.h"

namespace skylapse::image {

/// Light that no exposure of a picture shows beside the rest, as a share of its median.
inline constexpr double kDarkShare = 1e-4;
/// The same where that is nothing: far above subnormal numbers, which some processors take for
/// zero, and far below any unit of light.
inline constexpr double kDarkest = 1e-34;
/// A channel counts with at least this share of the pixel's strongest channel.
inline constexpr double kWeakChannelShare = 0.1;

struct ErrorScale {
  bool display = false;
  int colours = 3;
  float peak = 1;             // values are limited to 0 .. peak for the signal to noise ratio
  float floor = 0;            // of the colour channels
  std::vector<float> others;  // floors of the channels after them
  // What rounding in the files may have done to a sample; differences within it are none.
  float absolute_step = 0;  // in units of the samples
  float half_step = 0;      // as a share of the sample
  float rgbe_step = 0;      // in units of the last place of the strongest channel's eight bits
};

/// Of two pictures of one size with the same channels. Medians are taken over every n-th pixel, at
/// least 2^16 of them where there are as many.
ErrorScale error_scale(const Picture& a, const Picture& b);

}  // namespace skylapse::image
