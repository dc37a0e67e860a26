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
// The same in memory that is aligned as floats only.
using Float8InMemory = float __attribute__((vector_size(32), aligned(4), may_alias));

SKYLAPSE_INLINE Float8 load8(const float* p) { return *reinterpret_cast<const Float8InMemory*>(p); }

SKYLAPSE_INLINE Float4 lower(Float8 v) { return __builtin_shufflevector(v, v, 0, 1, 2, 3); }
SKYLAPSE_INLINE Float4 upper(Float8 v) { return __builtin_shufflevector(v, v, 4, 5, 6, 7); }

/// (k0 + t^2 k2) + t (k1 + t^2 k3), from {k0, k1} and {k2, k3}; never negative.
SKYLAPSE_INLINE Float4 cubic(Float8 k01, Float8 k23, float t) {
  const Float8 halves = k01 + (t * t) * k23;
  const Float4 value = lower(halves) + t * upper(halves);
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
  for (int interval = 0; interval < kIntervals; ++interval) {
    float sum[kIntervalFloats] = {};
    double constant[4] = {offset[0], offset[1], offset[2], offset[3]};
    for (int band = 0; band < bands.band_count; ++band) {
      const float weight = static_cast<float>(weights[band]);
      const float* k = bands.coefficients + (band * kIntervals + interval) * kIntervalFloats;
      const double* k0 = bands.constants + (band * kIntervals + interval) * 4;
      for (int j = 0; j < kIntervalFloats; ++j) sum[j] += weight * k[j];
      for (int j = 0; j < 4; ++j) constant[j] += weights[band] * k0[j];
    }
    for (int j = 0; j < 4; ++j) sum[j] = static_cast<float>(constant[j]);
    std::memcpy(row + interval * kIntervalFloats, sum, sizeof sum);
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
        const float* a = table + at.table_offset[i];
        const float* b = a + kRowFloats;
        const float f = at.w_fraction[i];
        const Float8 a01 = load8(a), a23 = load8(a + 8);
        const Float8 k01 = a01 + f * (load8(b) - a01);
        const Float8 k23 = a23 + f * (load8(b + 8) - a23);
        return cubic(k01, k23, at.q_fraction[i]);
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
          const float* a = row + offset[i];
          return cubic(load8(a), load8(a + 8), fraction[i]);
        });
  }
}

}  // namespace skylapse::sky::hosek_wilkie::kernel
