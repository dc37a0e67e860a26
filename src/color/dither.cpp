#include "color/dither.h"

#include <algorithm>
#include <vector>

#include "core/parallel.h"

namespace skylapse::color {
namespace {

/// Integer hash with nearly no bias between any input and output bit ("lowbias32", C. Wellons,
/// Hash Function Prospector, 2018, public domain).
inline uint32_t mix32(uint32_t h) {
  h ^= h >> 16;
  h *= 0x7feb352dU;
  h ^= h >> 15;
  h *= 0x846ca68bU;
  return h ^ (h >> 16);
}

/// SplitMix64 finaliser (Steele, Lea, Flood 2014), for the few keys that need all 64 bits.
inline uint64_t mix64(uint64_t h) {
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9ULL;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebULL;
  return h ^ (h >> 31);
}

/// One row. `column_hash` holds one hash per sample of the row, shared by all rows.
template <class Out>
void quantise_row(const float* in, size_t samples, const uint32_t* column_hash, uint32_t row_key,
                  float top, Out* out) {
  const auto itop = static_cast<int32_t>(top);
  for (size_t i = 0; i < samples; ++i) {
    const float unit = in[i] > 0.0f ? (in[i] < 1.0f ? in[i] : 1.0f) : 0.0f;  // NaN: 0
    const float v = unit * top;
    const uint32_t h = mix32(column_hash[i] ^ row_key);
    // Two independent uniforms on 2^16 cell centres: u in (0, 1), w in (-1/2, 1/2).
    const float u = (static_cast<float>(static_cast<int32_t>(h & 0xffffU)) + 0.5f) * 0x1p-16f;
    const float w = (static_cast<float>(static_cast<int32_t>(h >> 16)) - 32767.5f) * 0x1p-16f;
    const float room = 2.0f * (v < top - v ? v : top - v);
    const float fade = room < 1.0f ? room : 1.0f;
    // Whole code and remainder apart: a float near 65535 has no digits left for the noise.
    const auto code = static_cast<int32_t>(v);
    const float rest = v - static_cast<float>(code);
    // + 1 keeps the operand positive, so that truncation is floor.
    const int32_t step = static_cast<int32_t>(rest + fade * w + u + 1.0f) - 1;
    const int32_t sum = code + step;
    out[i] = static_cast<Out>(sum < 0 ? 0 : (sum > itop ? itop : sum));
  }
}

template <class Out>
void quantise(const float* rgb, size_t width, size_t height, uint64_t seed, float top, Out* out,
              size_t first_row) {
  const size_t samples = 3 * width;
  std::vector<uint32_t> column_hash(samples);
  for (size_t i = 0; i < samples; ++i) column_hash[i] = mix32(static_cast<uint32_t>(i) + 1U);
  constexpr size_t kRowsPerPiece = 32;
  parallel_for_ranges(height, kRowsPerPiece, [&](size_t begin, size_t end) {
    for (size_t y = begin; y < end; ++y) {
      const uint64_t key = mix64(mix64(seed + 0x9e3779b97f4a7c15ULL) + first_row + y);
      quantise_row(rgb + y * samples, samples, column_hash.data(), static_cast<uint32_t>(key), top,
                   out + y * samples);
    }
  });
}

}  // namespace

void quantise_u8(const float* rgb, size_t width, size_t height, uint64_t seed, uint8_t* out,
                 size_t first_row) {
  quantise(rgb, width, height, seed, 255.0f, out, first_row);
}

void quantise_u16(const float* rgb, size_t width, size_t height, uint64_t seed, uint16_t* out,
                  size_t first_row) {
  quantise(rgb, width, height, seed, 65535.0f, out, first_row);
}

}  // namespace skylapse::color
