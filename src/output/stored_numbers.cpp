#include "output/stored_numbers.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "core/parallel.h"

namespace skylapse::output {
namespace {

constexpr size_t kSamplesPerPiece = size_t{3} << 14;

/// Rounds pixels of `rgb` to RGBE and adds `offset` steps to each mantissa that is stored.
void to_rgbe(std::span<float> rgb, float offset) {
  assert(rgb.size() % 3 == 0);
  for (size_t i = 0; i < rgb.size(); i += 3) {
    float* const p = rgb.data() + i;
    const float largest = std::max({p[0], p[1], p[2]});
    assert(largest <= kLargestRgbe);
    if (!(largest >= 1e-32F)) {
      p[0] = p[1] = p[2] = 0;
      continue;
    }
    int exponent = 0;
    std::frexp(largest, &exponent);  // largest = [1/2, 1) 2^exponent
    // The largest mantissa must not round up to 256.
    if (std::nearbyint(std::ldexp(largest, 8 - exponent)) > 255) ++exponent;
    const float step = std::ldexp(1.0F, exponent - 8), per_step = std::ldexp(1.0F, 8 - exponent);
    for (int c = 0; c < 3; ++c)
      p[c] = (std::nearbyint(std::max(p[c], 0.0F) * per_step) + offset) * step;
  }
}

template <class Piece>
void in_pieces(std::span<float> values, const Piece& piece) {
  static_assert(kSamplesPerPiece % 3 == 0);
  const size_t pieces = (values.size() + kSamplesPerPiece - 1) / kSamplesPerPiece;
  parallel_for_ranges(pieces, 1, [&](size_t begin, size_t end) {
    const size_t first = begin * kSamplesPerPiece;
    piece(values.subspan(first, std::min(end * kSamplesPerPiece, values.size()) - first));
  });
}

}  // namespace

float rounded_to_half(float value) {
  const auto bits = std::bit_cast<uint32_t>(value);
  const uint32_t magnitude = bits & 0x7fffffffU, sign = bits & 0x80000000U;
  constexpr uint32_t kSmallestNormal = 0x38800000U;  // 2^-14
  constexpr uint32_t kOverflow = 0x477ff000U;        // 65520, halfway to 2^16
  constexpr uint32_t kInf = 0x7f800000U;
  if (magnitude > kInf) return value;
  if (magnitude >= kOverflow) return std::bit_cast<float>(sign | kInf);
  if (magnitude < kSmallestNormal) {
    // Below 2^-14 halves are multiples of 2^-24, as floats are between 1/2 and 1.
    const float shifted = std::bit_cast<float>(magnitude) + 0.5F;
    return std::bit_cast<float>(sign | std::bit_cast<uint32_t>(shifted - 0.5F));
  }
  const uint32_t odd = (magnitude >> 13) & 1U;
  return std::bit_cast<float>(sign | ((magnitude + 0xfffU + odd) & ~0x1fffU));
}

void round_to_half(std::span<float> values) {
  in_pieces(values, [](std::span<float> piece) {
    for (float& v : piece) v = rounded_to_half(v);
  });
}

void round_to_rgbe(std::span<float> rgb) {
  in_pieces(rgb, [](std::span<float> piece) { to_rgbe(piece, 0); });
}

void prepare_for_truncating_rgbe(std::span<float> rgb) {
  in_pieces(rgb, [](std::span<float> piece) { to_rgbe(piece, 0.5F); });
}

}  // namespace skylapse::output
