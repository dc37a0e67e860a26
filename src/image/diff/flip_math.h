#pragma once
// Functions of the pixel loops that the standard library offers no vectors of. Inlined, so that
// each loop is compiled for its own instruction set; free of branches.
#include <bit>
#include <cstdint>

#include "core/vector_kernel.h"

namespace skylapse::image::flip_internal {

/// Smallest float whose relative precision is whole.
inline constexpr float kSmallestNormal = 0x1p-126f;

/// log2(x) for normal x > 0. Error below 1e-7 + 6e-8 |log2 x| (tested); exact at 1.
/// Source: artanh series of (m - 1) / (m + 1) for the mantissa m in [sqrt 1/2, sqrt 2), next term
/// below 1e-9.
SKYLAPSE_INLINE float log2_of(float x) {
  constexpr std::int32_t kRootHalf = 0x3f3504f3;
  const std::int32_t bits = std::bit_cast<std::int32_t>(x);
  const std::int32_t exponent = (bits - kRootHalf) >> 23;
  const float m = std::bit_cast<float>(bits - (exponent << 23));
  const float s = (m - 1.0f) / (m + 1.0f), u = s * s;
  float p = 0.320598898f;  // 2 / ln 2 times 1/9, 1/7, 1/5, 1/3, 1
  p = p * u + 0.412198583f;
  p = p * u + 0.577078016f;
  p = p * u + 0.961796694f;
  p = p * u + 2.88539008f;
  return static_cast<float>(exponent) + s * p;
}

/// 2^x for x in [-126, 127], held to that. Relative error below 2e-7 (tested).
/// Source: Taylor series about the nearest whole number, next term 5e-9.
SKYLAPSE_INLINE float exp2_of(float x) {
  constexpr float kShift = 0x1.8p23f;  // adding it leaves the whole number in the low bits
  x = x > -126.0f ? x : -126.0f;
  x = x < 127.0f ? x : 127.0f;
  const float shifted = x + kShift;
  const float r = x - (shifted - kShift);
  float p = 1.52527338e-5f;  // (ln 2)^n / n!
  p = p * r + 1.54035304e-4f;
  p = p * r + 1.33335581e-3f;
  p = p * r + 9.61812911e-3f;
  p = p * r + 5.55041087e-2f;
  p = p * r + 2.40226507e-1f;
  p = p * r + 6.93147181e-1f;
  p = p * r + 1.0f;
  const std::int32_t power = (std::bit_cast<std::int32_t>(shifted) + 127) << 23;
  return p * std::bit_cast<float>(power);
}

/// x^y for x >= 0 and y in (0, 2.4] (0 for what is below the normal numbers). Relative error below
/// 4e-7 + 9e-8 |y log2 x| (tested): ln 2 times the error of the logarithm and half a unit of the
/// product, and the error of exp2.
SKYLAPSE_INLINE float power_of(float x, float y) {
  const float safe = x > kSmallestNormal ? x : kSmallestNormal;
  const float p = exp2_of(y * log2_of(safe));
  return x > kSmallestNormal ? p : 0.0f;
}

/// Cube root of v in [1e-3, 10]. Relative error below 3e-7 (tested).
/// A third of the exponent's bits, then two steps of Halley's method, each of which cubes the error
/// (first guess within 6 %).
SKYLAPSE_INLINE float cube_root(float v) {
  // (127 - 127 / 3 - 0.0331) 2^23: exponent bias, less what evens out the first guess's error.
  constexpr std::int32_t kCubeRootBias = 709957814;
  const auto bits = static_cast<float>(std::bit_cast<std::int32_t>(v));
  const auto third = static_cast<std::int32_t>(bits * (1.0f / 3.0f));
  float r = std::bit_cast<float>(third + kCubeRootBias);
  for (int step = 0; step < 2; ++step) {
    const float cube = r * r * r;
    r = r * ((cube + 2.0f * v) / (2.0f * cube + v));
  }
  return r;
}

}  // namespace skylapse::image::flip_internal
