#pragma once
// Quantising display values to integers with reproducible noise, so that skies show no bands.
#include <cstddef>
#include <cstdint>

namespace skylapse::color {

/// 0..1 to 0..255 with triangular noise of one code either side (sum of two uniforms).
/// The mean is kept exactly at every value, ends included: within half a code of 0 and of 1 the
/// second uniform fades out, so nothing is ever pushed outside and clamped back. 0 gives 0 and 1
/// gives 255 without noise. Values outside 0..1 are clamped first; NaN gives 0.
/// Source  Lipshitz, Wannamaker, Vanderkooy 1992, J. Audio Eng. Soc. 40:355 (the triangular sum
///         makes mean and variance of the error independent of the signal).
/// The noise is a function of (column, row, channel, seed) alone: same input, same bytes, on any
/// number of threads; `first_row` is that of a piece of a picture. Seed with the frame's time, so
/// that the grain moves from frame to frame.
void quantise_u8(const float* rgb, size_t width, size_t height, uint64_t seed, uint8_t* out,
                 size_t first_row = 0);

/// The same to 0..65535.
void quantise_u16(const float* rgb, size_t width, size_t height, uint64_t seed, uint16_t* out,
                  size_t first_row = 0);

}  // namespace skylapse::color
