#pragma once
// The numbers that a file of less precision than float holds, as floats: so that what a file shines
// can be weighed without reading it again, and rounded the way it should be.
#include <cstddef>
#include <span>

namespace skylapse::output {

/// Rounds to the nearest half float (IEEE 754-2008 binary16, ties to even, subnormals kept); beyond
/// 65519.99 to Inf. NaN stays NaN.
float rounded_to_half(float value);

/// Rounds all values to half floats, in place.
void round_to_half(std::span<float> values);

/// Largest value of a Radiance RGBE pixel: 255 * 2^119.
inline constexpr float kLargestRgbe = 1.6947656946257677e38F;

/// Rounds RGB pixels to what Radiance RGBE stores, in place: three mantissas of 8 bits under one
/// exponent, each rounded to the nearest, so that sums over many pixels keep their value.
/// Source   G. Ward, "Real Pixels", Graphics Gems II, 1991; mantissa m stands for m 2^(e - 136), as
///          OpenImageIO, stb_image, three.js, Blender and Unreal read it. (Radiance's own programs
///          cut off when writing and add half a step when reading: they see 1/2 step more.)
/// Error    at most 1/256 of the largest channel in any channel (0.39 %); 0 on average.
/// Domain   finite pixels of at most kLargestRgbe (asserted); negative channels, which RGBE does
///          not have, become 0, and so do pixels below 1e-32.
void round_to_rgbe(std::span<float> rgb);

/// The same with half a step added to each mantissa: what a writer must be given that cuts off.
void prepare_for_truncating_rgbe(std::span<float> rgb);

}  // namespace skylapse::output
