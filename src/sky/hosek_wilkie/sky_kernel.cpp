// Compiled with -O3 -fno-math-errno -fno-trapping-math: gcc 12 does not vectorise these loops at
// -O2. No -ffast-math: it would switch denormals off in the whole process.
#include "sky/hosek_wilkie/sky_kernel.h"

#include <cmath>
#include <cstring>

#include "core/vector_kernel.h"

namespace skylapse::sky::hosek_wilkie::kernel {
namespace {

using Float4 = float __attribute__((vector_size(16)));
using Float8 = float __attribute__((vector_size(32)));
using Float16 = float __attribute__((vector_size(64)));

using Double2 = double __attribute__((vector_size(16)));
using Double4 = double __attribute__((vector_size(32)));

/// The vector of doubles to go with a vector of floats; four sums are all there is to hold.
template <class Vector>
struct DoublesBeside {
  using type = Double4;
};
template <>
struct DoublesBeside<Float4> {
  using type = Double2;
};

/// From memory that is aligned as its elements only.
template <class Vector, class Element>
SKYLAPSE_INLINE Vector load(const Element* p) {
  Vector v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

/// The sixteen coefficients of one interval, in one, two or four vectors.
template <class Vector>
struct Interval {
  static constexpr int kLanes = sizeof(Vector) / sizeof(float);
  static constexpr int kParts = kIntervalFloats / kLanes;
  Vector part[kParts];
};

/// Between two rows: a + f (b - a).
template <class Vector>
SKYLAPSE_INLINE Interval<Vector> between(const float* a, const float* b, float f) {
  Interval<Vector> k;
  for (int n = 0; n < k.kParts; ++n) {
    const Vector low = load<Vector>(a + n * k.kLanes);
    k.part[n] = low + f * (load<Vector>(b + n * k.kLanes) - low);
  }
  return k;
}

template <class Vector>
SKYLAPSE_INLINE Interval<Vector> at(const float* p) {
  Interval<Vector> k;
  for (int n = 0; n < k.kParts; ++n) k.part[n] = load<Vector>(p + n * k.kLanes);
  return k;
}

SKYLAPSE_INLINE Float4 not_negative(Float4 v) {
  const Float4 zero{};
  return v > zero ? v : zero;
}

/// (k0 + t k1) + t^2 (k2 + t k3), never negative; coefficients in the order of kPowers.
SKYLAPSE_INLINE Float4 cubic(const Interval<Float4>& k, float t) {
  return not_negative((k.part[0] + t * k.part[2]) + (t * t) * (k.part[1] + t * k.part[3]));
}
SKYLAPSE_INLINE Float4 cubic(const Interval<Float8>& k, float t) {
  const Float8 sum = k.part[0] + t * k.part[1];
  const Float4 low = __builtin_shufflevector(sum, sum, 0, 1, 2, 3);
  const Float4 high = __builtin_shufflevector(sum, sum, 4, 5, 6, 7);
  return not_negative(low + (t * t) * high);
}
SKYLAPSE_INLINE Float4 cubic(const Interval<Float16>& k, float t) {
  const Float16 all = k.part[0];
  return cubic(Interval<Float8>{__builtin_shufflevector(all, all, 0, 1, 2, 3, 4, 5, 6, 7),
                                __builtin_shufflevector(all, all, 8, 9, 10, 11, 12, 13, 14, 15)},
               t);
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

template <class Vector>
SKYLAPSE_INLINE void combine_bands_in(const BandPolynomials& bands, const double* weights,
                                      const double* offset, float* row) {
  // Several sums at a time: one alone would wait for its own additions.
  constexpr int kAtOnce = Interval<Vector>::kLanes / 4;
  using Double = typename DoublesBeside<Vector>::type;
  constexpr int kDoubles = sizeof(Double) / sizeof(double);
  const int stride = bands.band_count * kIntervalFloats;
  for (int first = 0; first < kIntervals; first += kAtOnce) {
    Interval<Vector> sum[kAtOnce] = {};
    Double constant[kAtOnce][4 / kDoubles] = {};
    const float* k = bands.coefficients + first * stride;
    const double* k0 = bands.constants + first * bands.band_count * 4;
    for (int band = 0; band < bands.band_count; ++band, k += kIntervalFloats, k0 += 4) {
      const float weight = static_cast<float>(weights[band]);
      for (int n = 0; n < kAtOnce; ++n) {
        for (int part = 0; part < Interval<Vector>::kParts; ++part)
          sum[n].part[part] +=
              weight * load<Vector>(k + n * stride + part * Interval<Vector>::kLanes);
        for (int part = 0; part < 4 / kDoubles; ++part)
          constant[n][part] +=
              weights[band] * load<Double>(k0 + n * bands.band_count * 4 + part * kDoubles);
      }
    }
    for (int n = 0; n < kAtOnce; ++n) {
      float* out = row + (first + n) * kIntervalFloats;
      std::memcpy(out, &sum[n], sizeof sum[n]);
      for (int c = 0; c < 4; ++c)
        out[c] = static_cast<float>(constant[n][c / kDoubles][c % kDoubles] + offset[c]);
    }
  }
}

template <class Vector>
SKYLAPSE_INLINE void look_up_in(const float* table, const BlockCoordinates& place, int count,
                                float* rgb) {
  store_pixels(
      count, rgb, [&](int i) __attribute__((always_inline)) {
        const float* row = table + place.table_offset[i];
        return cubic(between<Vector>(row, row + kRowFloats, place.w_fraction[i]),
                     place.q_fraction[i]);
      });
}

template <class Vector>
SKYLAPSE_INLINE void look_up_row_in(const float* row, const RowCoordinates& place, int count,
                                    float* rgb) {
  store_pixels(
      count, rgb, [&](int i) __attribute__((always_inline)) {
        return cubic(at<Vector>(row + place.table_offset[i]), place.q_fraction[i]);
      });
}

/// The loops with vectors of one width.
struct Versions {
  void (*combine_bands)(const BandPolynomials&, const double*, const double*, float*);
  void (*look_up)(const float*, const BlockCoordinates&, int, float*);
  void (*look_up_row)(const float*, const RowCoordinates&, int, float*);
};

struct Narrow {
  static void combine_bands(const BandPolynomials& bands, const double* weights,
                            const double* offset, float* row) {
    combine_bands_in<Float4>(bands, weights, offset, row);
  }
  static void look_up(const float* table, const BlockCoordinates& place, int count, float* rgb) {
    look_up_in<Float4>(table, place, count, rgb);
  }
  static void look_up_row(const float* row, const RowCoordinates& place, int count, float* rgb) {
    look_up_row_in<Float4>(row, place, count, rgb);
  }
};

struct Wide {
  SKYLAPSE_V3 static void combine_bands(const BandPolynomials& bands, const double* weights,
                                        const double* offset, float* row) {
    combine_bands_in<Float8>(bands, weights, offset, row);
  }
  SKYLAPSE_V3 static void look_up(const float* table, const BlockCoordinates& place, int count,
                                  float* rgb) {
    look_up_in<Float8>(table, place, count, rgb);
  }
  SKYLAPSE_V3 static void look_up_row(const float* row, const RowCoordinates& place, int count,
                                      float* rgb) {
    look_up_row_in<Float8>(row, place, count, rgb);
  }
};

struct Widest {
  SKYLAPSE_V4 static void combine_bands(const BandPolynomials& bands, const double* weights,
                                        const double* offset, float* row) {
    combine_bands_in<Float16>(bands, weights, offset, row);
  }
  SKYLAPSE_V4 static void look_up(const float* table, const BlockCoordinates& place, int count,
                                  float* rgb) {
    look_up_in<Float16>(table, place, count, rgb);
  }
  SKYLAPSE_V4 static void look_up_row(const float* row, const RowCoordinates& place, int count,
                                      float* rgb) {
    look_up_row_in<Float16>(row, place, count, rgb);
  }
};

template <class Set>
constexpr Versions versions_of() {
  return {Set::combine_bands, Set::look_up, Set::look_up_row};
}

/// What this machine can run; asked once.
const Versions& best() {
  static const Versions versions = [] {
#if SKYLAPSE_X86
    if (__builtin_cpu_supports("x86-64-v4")) return versions_of<Widest>();
    if (__builtin_cpu_supports("x86-64-v3")) return versions_of<Wide>();
#endif
    return versions_of<Narrow>();
  }();
  return versions;
}

}  // namespace

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
int direction_coordinates(const RowView& view, const Vec3f* directions, int count,
                          BlockCoordinates& out) {
  int low = 0;
  for (int i = 0; i < count; ++i)
    low += place_direction(view, directions[i].x, directions[i].y, directions[i].z, i, out);
  return low;
}

SKYLAPSE_CLONES
int stereographic_coordinates(const RowView& view, float k, int count, BlockCoordinates& out) {
  return fisheye_coordinates(view, count, out, [k](float r2, float& s_over_r, float& c) {
    c = 1.0f / std::sqrt(1.0f + k * k * r2);
    s_over_r = k * c;
  });
}

void combine_bands(const BandPolynomials& bands, const double* weights, const double* offset,
                   float* row) {
  best().combine_bands(bands, weights, offset, row);
}

void look_up(const float* table, const BlockCoordinates& place, int count, float* rgb) {
  best().look_up(table, place, count, rgb);
}

void look_up_row(const float* row, const RowCoordinates& place, int count, float* rgb) {
  best().look_up_row(row, place, count, rgb);
}

SKYLAPSE_CLONES
void level_coordinates(const LevelRow& level, int first, int count, RowCoordinates& out) {
  for (int i = 0; i < count; ++i) {
    const float near = level.near_base + level.slope * level.near[first + i];
    const float far = level.far_base + level.slope * level.far[first + i];
    const float root = std::sqrt(near < far ? near : far);
    std::int32_t interval;
    place_q(near < far ? root : 2.0f - root, interval, out.q_fraction[i]);
    out.table_offset[i] = interval * kIntervalFloats;
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
