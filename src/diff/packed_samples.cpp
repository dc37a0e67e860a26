#include "diff/packed_samples.h"

#include <zlib.h>

#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/base64.h"

namespace skylapse::diff {
namespace {

uint32_t code_of(float value, int shift) {
  if (std::isnan(value)) return 0x7fc00000u >> shift;
  if (value == 0) return 0;
  const uint32_t bits = std::bit_cast<uint32_t>(value);
  const uint32_t sign = bits & 0x80000000u, size = bits & 0x7fffffffu;
  if (std::isinf(value)) return bits >> shift;
  const uint32_t rounded = (size + (shift > 0 ? 1u << (shift - 1) : 0u)) >> shift;
  const uint32_t largest = (0x7f800000u >> shift) - 1;
  return std::min(rounded, largest) | sign >> shift;
}

/// Differences to a prediction, zigzag: 0, -1, 1, -2, ... as 0, 1, 2, 3.
class Residuals {
 public:
  Residuals(const Codes& codes, const Codes* base) : codes_(codes), base_(base) {}

  [[nodiscard]] std::vector<uint32_t> of(Prediction prediction) const {
    const size_t w = codes_.width, plane = w * size_t(codes_.height);
    const bool from_base = prediction != Prediction::neighbours;
    const bool from_neighbours = prediction != Prediction::base;
    const auto value = [&](size_t i) {
      return from_base ? codes_.values[i] - base_->values[i] : codes_.values[i];
    };
    std::vector<uint32_t> out(codes_.values.size());
    for (size_t i = 0; i < out.size(); ++i) {
      const size_t x = i % w, y = i % plane / w;
      uint32_t expected = 0;
      if (from_neighbours && x > 0) expected += value(i - 1);
      if (from_neighbours && y > 0) expected += value(i - w);
      if (from_neighbours && x > 0 && y > 0) expected -= value(i - w - 1);
      out[i] = zigzag(value(i) - expected);
    }
    return out;
  }

 private:
  [[nodiscard]] uint32_t zigzag(uint32_t difference) const {
    const int unused = 32 - codes_.bits;
    const int32_t wrapped = int32_t(difference << unused) >> unused;
    return (uint32_t(wrapped) << 1 ^ uint32_t(wrapped >> 31)) & ((1u << codes_.bits) - 1);
  }

  const Codes& codes_;
  const Codes* base_;
};

/// About as many bits as they take: what the choice between predictions goes by.
uint64_t estimated_bits(const std::vector<uint32_t>& residuals) {
  uint64_t bits = 0;
  for (const uint32_t r : residuals) bits += std::bit_width(r);
  return bits;
}

std::string deflated(const std::vector<uint32_t>& residuals, int bits) {
  const int planes = (bits + 7) / 8;
  std::vector<uint8_t> bytes(residuals.size() * planes);
  for (int p = 0; p < planes; ++p)
    for (size_t i = 0; i < residuals.size(); ++i)
      bytes[p * residuals.size() + i] = uint8_t(residuals[i] >> (8 * p));
  uLongf size = compressBound(bytes.size());
  std::vector<std::byte> stream(size);
  [[maybe_unused]] const int status = compress2(reinterpret_cast<Bytef*>(stream.data()), &size,
                                                bytes.data(), bytes.size(), Z_DEFAULT_COMPRESSION);
  assert(status == Z_OK);  // the buffer is large enough
  return base64(std::span(stream).first(size));
}

}  // namespace

Codes float_codes(std::span<const float> samples, int width, int height, int channels,
                  int mantissa_bits) {
  assert(mantissa_bits >= 1 && mantissa_bits <= 22);
  assert(samples.size() == size_t(width) * size_t(height) * size_t(channels));
  Codes codes{width, height, channels, 9 + mantissa_bits, {}};
  codes.values.reserve(samples.size());
  for (int c = 0; c < channels; ++c)
    for (size_t i = c; i < samples.size(); i += channels)
      codes.values.push_back(code_of(samples[i], 23 - mantissa_bits));
  return codes;
}

float float_of_code(uint32_t code, int bits) { return std::bit_cast<float>(code << (32 - bits)); }

PackedCodes packed(const Codes& codes, const Codes* base) {
  const Residuals residuals(codes, base);
  PackedCodes best;
  std::vector<uint32_t> chosen = residuals.of(Prediction::neighbours);
  if (base != nullptr) {
    assert(base->values.size() == codes.values.size() && base->bits == codes.bits);
    uint64_t fewest = estimated_bits(chosen);
    for (const Prediction p : {Prediction::base, Prediction::base_and_neighbours}) {
      auto tried = residuals.of(p);
      const uint64_t bits = estimated_bits(tried);
      if (bits >= fewest) continue;
      fewest = bits, chosen = std::move(tried), best.prediction = p;
    }
  }
  best.text = deflated(chosen, codes.bits);
  return best;
}

}  // namespace skylapse::diff
