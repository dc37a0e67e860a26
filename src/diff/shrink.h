#pragma once
// Pictures and maps made small enough for a page without hiding what is wrong with them.
#include <span>
#include <vector>

#include "image/diff/picture.h"

namespace skylapse::diff {

/// By how much a picture is shrunk in both directions: to at most `max_width` columns and
/// max_width^2 pixels. 1: not at all.
int shrink_factor(int width, int height, int max_width);

/// Mean of factor x factor pixels (fewer at the right and lower edges), with the first `channels`
/// channels. Samples that are no numbers win over those that are, NaN before Inf; of samples
/// below -0.1 % of their pixel's strongest channel the lowest is taken.
image::Picture shrunk(const image::Picture& picture, int factor, int channels);

/// The value of the largest size among factor x factor ones: no error is averaged away.
std::vector<float> shrunk_by_largest(std::span<const float> values, int width, int height,
                                     int factor);

}  // namespace skylapse::diff
