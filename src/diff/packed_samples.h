#pragma once
// Pixels inside a page: few bytes, and near enough to the file to look at differences of a part in
// a thousand at any exposure.
//
// A float is a code: its bits, rounded to a short mantissa. That keeps what half floats lose (suns
// of 1e10, airglow of 1e-9, NaN, Inf) and costs nothing, because the exponents of neighbours are
// alike: each code is predicted from its neighbours (left + above - above left; for B also from A),
// and the differences, zigzag, are deflated byte by byte. A browser undoes it with
// DecompressionStream, without a decoder of images that might manage colours or alpha.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace skylapse::diff {

/// Whole numbers of `bits` bits in planes (channel by channel, row by row).
struct Codes {
  int width = 0, height = 0, channels = 0;
  int bits = 0;  // at most 31
  std::vector<uint32_t> values;
};

/// `samples` are interleaved. A finite value is off by at most 2^-(mantissa_bits + 1) of itself and
/// stays finite; NaN and Inf stay what they are; -0 is 0. Takes 9 + mantissa_bits bits.
Codes float_codes(std::span<const float> samples, int width, int height, int channels,
                  int mantissa_bits);

/// What a code stands for.
float float_of_code(uint32_t code, int bits);

enum class Prediction {
  neighbours,           // of the same picture
  base,                 // the same pixel of the other picture
  base_and_neighbours,  // the difference to it from the neighbours' differences
};

struct PackedCodes {
  Prediction prediction = Prediction::neighbours;
  std::string text;  // base64 of a zlib stream: all low bytes, then all second bytes, ...
};

/// `base`: codes of the same size that the reader will have, or null.
PackedCodes packed(const Codes& codes, const Codes* base);

}  // namespace skylapse::diff
