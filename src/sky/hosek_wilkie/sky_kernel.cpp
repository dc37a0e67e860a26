// Compiled with -O3 -fno-math-errno -fno-trapping-math: gcc 12 does not vectorise these loops at
// -O2. No -ffast-math: it would switch denormals off in the whole process.
#include "sky/hosek_wilkie/sky_kernel.h"

#include <cmath>
#include <cstring>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define SKYLAPSE_CLONES \
  __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define SKYLAPSE_CLONES
#endif
#define SKYLAPSE_INLINE static inline __attribute__((always_inline))

namespace skylapse::sky::hosek_wilkie::kernel {
namespace {

using Float4 = float __attribute__((vector_size(16)));
using Float8 = float __attribute__((vector_size(32)));
using Float16 = float __attribute__((vector_size(64)));
using Double4 = double __attribute__((vector_size(32)));
// The same in memory that is aligned as its elements only.
using Float16InMemory = float __attribute__((vector_size(64), aligned(4), may_alias));
using Double4InMemory = double __attribute__((vector_size(32), aligned(8), may_alias));

SKYLAPSE_INLINE Float16 load16(const float* p) {
  return *reinterpret_cast<const Float16InMemory*>(p);
}

SKYLAPSE_INLINE Double4 load4(const double* p) {
  return *reinterpret_cast<const Double4InMemory*>(p);
}

/// Value of one interval's polynomial, coefficients in the order of kPowers; never negative.
SKYLAPSE_INLINE Float4 cubic(Float16 k, float t) {
  const Float8 k02 = __builtin_shufflevector(k, k, 0, 1, 2, 3, 4, 5, 6, 7);
  const Float8 k13 = __builtin_shufflevector(k, k, 8, 9, 10, 11, 12, 13, 14, 15);
  const Float4 t4 = {t, t, t, t};
  const Float8 t8 = __builtin_shufflevector(t4, t4, 0, 1, 2, 3, 0, 1, 2, 3);
  const Float8 sum = k02 + t8 * k13;
  const Float4 low = __builtin_shufflevector(sum, sum, 0, 1, 2, 3);
  const Float4 high = __builtin_shufflevector(sum, sum, 4, 5, 6, 7);
  const Float4 value = low + (t4 * t4) * high;
  const Float4 zero{};
  return value > zero ? value : zero;
}

/// Writes R, G, B of pixels 0 .. count-1. All but the last store four floats, of which the next
/// pixel overwrites one.
template <class Value>
SKYLAPSE_INLINE void store_pixels(int count, float* rgb, Value value) {
  for (int i = 0; i + 1 < count; ++i) {
    const Float4 v = value(i);
    std::memcpy(rgb + 3 * i, &v, sizeof v);
  }
  const Float4 last = value(count - 1);
  std::memcpy(rgb + 3 * (count - 1), &last, 3 * sizeof(float));
}

/// Interval of q and place within it.
SKYLAPSE_INLINE void place_q(float q, std::int32_t& interval, float& fraction) {
  const float t = q * (kIntervals / 2.0f);
  const int i = static_cast<int>(t);
  interval = i < kIntervals ? i : kIntervals - 1;
  fraction = t - static_cast<float>(interval);
}

/// Direction v (unit) to table coordinates.
SKYLAPSE_INLINE int place_direction(const RowView& view, float vx, float vy, float vz, int i,
                                    BlockCoordinates& out) {
  // The chord to the sun, or beyond 90 deg to the antisolar point: 1 - cos gamma itself would
  // lose the digits that matter at either.
  const float dot = vx * view.sun.x + vy * view.sun.y + vz * view.sun.z;
  const float side = dot < 0.0f ? -1.0f : 1.0f;
  const float dx = vx - side * view.sun.x;
  const float dy = vy - side * view.sun.y;
  const float dz = vz - side * view.sun.z;
  const float chord = std::sqrt(0.5f * (dx * dx + dy * dy + dz * dz));
  const float q = dot < 0.0f ? 2.0f - chord : chord;
  const float sine = vx * view.zenith.x + vy * view.zenith.y + vz * view.zenith.z;
  const float s = std::sqrt(sine > 0.0f ? sine : 0.0f) * static_cast<float>(kRowSteps);
  int row = static_cast<int>(s);
  row = row < kRowSteps ? row : kRowSteps - 1;
  std::int32_t interval;
  place_q(q, interval, out.q_fraction[i]);
  out.w_fraction[i] = s - static_cast<float>(row);
  out.table_offset[i] = row * kRowFloats + interval * kIntervalFloats;
  out.sine[i] = sine;
  return sine < view.low_sine ? 1 : 0;
}

/// `half` gives sin(theta/2) / r and cos(theta/2) for r^2.
template <class HalfAngle>
SKYLAPSE_INLINE int fisheye_coordinates(const RowView& view, int count, BlockCoordinates& out,
                                        HalfAngle half) {
  int low = 0;
  for (int i = 0; i < count; ++i) {
    const float x = view.x_first + static_cast<float>(i) * view.x_step;
    const float r2 = x * x + view.y * view.y;
    float s_over_r, c;
    half(r2, s_over_r, c);
    const float k = 2.0f * s_over_r * c;
    low += place_direction(view, k * x, k * view.y, 1.0f - 2.0f * s_over_r * s_over_r * r2, i, out);
  }
  return low;
}

}  // namespace

SKYLAPSE_CLONES
void combine_bands(const BandPolynomials& bands, const double* weights, const double* offset,
                   float* row) {
  // Several intervals at a time: one sum alone would wait for its own additions.
  constexpr int kAtOnce = 4;
  static_assert(kIntervals % kAtOnce == 0);
  const int stride = bands.band_count * kIntervalFloats;
  for (int first = 0; first < kIntervals; first += kAtOnce) {
    Float16 sum[kAtOnce] = {};
    Double4 constant[kAtOnce] = {};
    const float* k = bands.coefficients + first * stride;
    const double* k0 = bands.constants + first * bands.band_count * 4;
    for (int band = 0; band < bands.band_count; ++band) {
      for (int n = 0; n < kAtOnce; ++n) {
        sum[n] += static_cast<float>(weights[band]) * load16(k + n * stride);
        constant[n] += weights[band] * load4(k0 + n * bands.band_count * 4);
      }
      k += kIntervalFloats;
      k0 += 4;
    }
    for (int n = 0; n < kAtOnce; ++n) {
      float* out = row + (first + n) * kIntervalFloats;
      std::memcpy(out, &sum[n], sizeof sum[n]);
      for (int c = 0; c < 4; ++c) out[c] = static_cast<float>(constant[n][c] + offset[c]);
    }
  }
}

SKYLAPSE_CLONES
int plane_coordinates(const RowView& view, int count, BlockCoordinates& out) {
  int low = 0;
  for (int i = 0; i < count; ++i) {
    const float x = view.x_first + static_cast<float>(i) * view.x_step;
    const float k = 1.0f / std::sqrt(1.0f + x * x + view.y * view.y);
    low += place_direction(view, k * x, k * view.y, k, i, out);
  }
  return low;
}

SKYLAPSE_CLONES
int equidistant_coordinates(const RowView& view, float k, int count, BlockCoordinates& out) {
  // Taylor series of sin(t)/t and cos(t) in t^2, t = theta/2 up to 90 deg: next terms below 4e-8.
  return fisheye_coordinates(view, count, out, [k](float r2, float& s_over_r, float& c) {
    const float u = k * k * r2;
    const float sinc =
        1.0f +
        u * (-1.0f / 6 +
             u * (1.0f / 120 + u * (-1.0f / 5040 + u * (1.0f / 362880 + u * (-1.0f / 39916800)))));
    c = 1.0f +
        u * (-0.5f + u * (1.0f / 24 +
                          u * (-1.0f / 720 + u * (1.0f / 40320 + u * (-1.0f / 3628800 +
                                                                      u * (1.0f / 479001600))))));
    s_over_r = k * sinc;
  });
}

SKYLAPSE_CLONES
int equisolid_coordinates(const RowView& view, float k, int count, BlockCoordinates& out) {
  return fisheye_coordinates(view, count, out, [k](float r2, float& s_over_r, float& c) {
    const float c2 = 1.0f - k * k * r2;
    c = std::sqrt(c2 > 0.0f ? c2 : 0.0f);
    s_over_r = k;
  });
}

SKYLAPSE_CLONES
int stereographic_coordinates(const RowView& view, float k, int count, BlockCoordinates& out) {
  return fisheye_coordinates(view, count, out, [k](float r2, float& s_over_r, float& c) {
    c = 1.0f / std::sqrt(1.0f + k * k * r2);
    s_over_r = k * c;
  });
}

SKYLAPSE_CLONES
void look_up(const float* table, const BlockCoordinates& at, int count, float* rgb) {
  store_pixels(
      count, rgb, [&](int i) __attribute__((always_inline)) {
        const float* below = table + at.table_offset[i];
        const Float16 k = load16(below);
        return cubic(k + at.w_fraction[i] * (load16(below + kRowFloats) - k), at.q_fraction[i]);
      });
}

SKYLAPSE_CLONES
void look_up_level_row(const float* row, const LevelRow& level, int count, float* rgb) {
  alignas(64) float fraction[kBlock];
  alignas(64) std::int32_t offset[kBlock];
  for (int first = 0; first < count; first += kBlock) {
    const int n = count - first < kBlock ? count - first : kBlock;
    for (int i = 0; i < n; ++i) {
      const float near = level.near_base + level.slope * level.near[first + i];
      const float far = level.far_base + level.slope * level.far[first + i];
      const float q = near <= far ? std::sqrt(near) : 2.0f - std::sqrt(far);
      std::int32_t interval;
      place_q(q, interval, fraction[i]);
      offset[i] = interval * kIntervalFloats;
    }
    store_pixels(
        n, rgb + 3 * first, [&](int i) __attribute__((always_inline)) {
          return cubic(load16(row + offset[i]), fraction[i]);
        });
  }
}

SKYLAPSE_CLONES
void fill_pixels(int count, Colour colour, float* rgb) {
  constexpr int kTogether = 16;  // pixels: 48 floats, three cache lines
  float pattern[3 * kTogether];
  for (int i = 0; i < kTogether; ++i) {
    pattern[3 * i] = colour.r;
    pattern[3 * i + 1] = colour.g;
    pattern[3 * i + 2] = colour.b;
  }
  int i = 0;
  for (; i + kTogether <= count; i += kTogether) std::memcpy(rgb + 3 * i, pattern, sizeof pattern);
  std::memcpy(rgb + 3 * i, pattern, sizeof(float) * 3 * static_cast<size_t>(count - i));
}

}  // namespace skylapse::sky::hosek_wilkie::kernel
