// Compiled with -O3 -fno-math-errno -fno-trapping-math (vector_kernel.h), and -ffp-contract=off:
// every operation is rounded as IEEE 754 says, in one order, on every machine.
#include "image/diff/flip_kernels.h"

#include <cmath>
#include <cstring>

#include "core/vector_kernel.h"
#include "image/diff/flip_colour.h"
#include "image/diff/flip_math.h"

namespace skylapse::image::flip_internal {
namespace {

using Float4 = float __attribute__((vector_size(16)));
using Float8 = float __attribute__((vector_size(32)));
using Float16 = float __attribute__((vector_size(64)));

template <class Vector>
SKYLAPSE_INLINE Vector load(const float* p) {
  Vector v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

/// sum + taps[k] pair(rows[k], rows[-k]) for k from 1, of four vectors at a time: their sums stay
/// in registers and do not wait for each other.
template <class Vector, class Start, class Pair>
SKYLAPSE_INLINE void filter(const float* const* rows, const float* taps, int radius, int count,
                            float* out, Start start, Pair pair) {
  constexpr int kLanes = sizeof(Vector) / sizeof(float), kAtOnce = 4;
  static_assert(kPixelBlock % (kLanes * kAtOnce) == 0);
  for (int x = 0; x < count; x += kLanes * kAtOnce) {
    Vector sum[kAtOnce];
    for (int i = 0; i < kAtOnce; ++i) sum[i] = start(x + i * kLanes);
    for (int k = 1; k <= radius; ++k) {
      const float* after = rows[k] + x;
      const float* before = rows[-k] + x;
      for (int i = 0; i < kAtOnce; ++i)
        sum[i] +=
            taps[k] * pair(load<Vector>(after + i * kLanes), load<Vector>(before + i * kLanes));
    }
    for (int i = 0; i < kAtOnce; ++i) std::memcpy(out + x + i * kLanes, &sum[i], sizeof sum[i]);
  }
}

template <class Vector>
SKYLAPSE_INLINE void filter_even_in(const float* const* rows, const float* taps, int radius,
                                    int count, bool add, float* out) {
  const auto plus = [](Vector a, Vector b) __attribute__((always_inline)) { return a + b; };
  if (add)
    filter<Vector>(
        rows, taps, radius, count, out,
        [&](int x) __attribute__((always_inline)) {
          return load<Vector>(out + x) + taps[0] * load<Vector>(rows[0] + x);
        },
        plus);
  else
    filter<Vector>(
        rows, taps, radius, count, out,
        [&](int x) __attribute__((always_inline)) { return taps[0] * load<Vector>(rows[0] + x); },
        plus);
}

template <class Vector>
SKYLAPSE_INLINE void filter_odd_in(const float* const* rows, const float* taps, int radius,
                                   int count, float* out) {
  filter<Vector>(
      rows, taps, radius, count, out, [](int) __attribute__((always_inline)) { return Vector{}; },
      [](Vector a, Vector b) __attribute__((always_inline)) { return a - b; });
}

SKYLAPSE_INLINE float limited(float v) {
  v = v > 0.0f ? v : 0.0f;
  return v < 1.0f ? v : 1.0f;
}

/// Writes colour `mean`, `difference` of pixel i in opponent colours.
SKYLAPSE_INLINE void store_opponent(const OpponentRows& out, int i, Rgb mean, Rgb difference) {
  const Xyz m = xyz_of(mean), d = xyz_of(difference);
  out.mean[0][i] = m.y;
  out.mean[1][i] = m.x - m.y;
  out.mean[2][i] = m.y - m.z;
  out.difference[0][i] = d.y;
  out.difference[1][i] = d.x - d.y;
  out.difference[2][i] = d.y - d.z;
}

SKYLAPSE_INLINE void decode_srgb_in(float* values, int count) {
  for (int i = 0; i < count; ++i) {
    const float v = values[i];
    const float curve = power_of((v + 0.055f) * (1.0f / 1.055f), 2.4f);
    values[i] = v > 0.04045f ? curve : v * (1.0f / 12.92f);
  }
}

SKYLAPSE_INLINE void oppose_in(const ColourRows& in, int count, const OpponentRows& out) {
  const ColourRows rows = in;
  const OpponentRows result = out;
  SKYLAPSE_INDEPENDENT_TURNS
  for (int i = 0; i < count; ++i) {
    const Rgb a{rows.first[0][i], rows.first[1][i], rows.first[2][i]};
    const Rgb b{rows.second[0][i], rows.second[1][i], rows.second[2][i]};
    store_opponent(result, i, {0.5f * (a.r + b.r), 0.5f * (a.g + b.g), 0.5f * (a.b + b.b)},
                   {b.r - a.r, b.g - a.g, b.b - a.b});
  }
}

/// A channel of both pictures as the display shows it.
struct Shown {
  float mean, difference;
};

SKYLAPSE_INLINE Shown limited_pair(float a, float b, float difference) {
  const float shown_a = limited(a), shown_b = limited(b);
  const float between = shown_b - shown_a;
  // Within the limits the exact difference, not that of two rounded numbers.
  const float outside = std::fabs(a - shown_a) + std::fabs(b - shown_b);
  return {0.5f * (shown_a + shown_b), outside > 0.0f ? between : difference};
}

/// The difference of y over that of x is [(k0 k4 - k1 k3) a b + k0 k5 (a + b) + k1 k5] over both
/// denominators.
SKYLAPSE_INLINE Shown toned(float first, float second, const RationalCurve& c, float scale) {
  float a = first * scale, b = second * scale;
  a = a < c.limit ? a : c.limit;
  b = b < c.limit ? b : c.limit;
  const float under_a = (c.k3 * a + c.k4) * a + c.k5, under_b = (c.k3 * b + c.k4) * b + c.k5;
  const float both = 1.0f / (under_a * under_b);
  const float slope = (c.k0 * c.k4 - c.k1 * c.k3) * (a * b) + (c.k0 * c.k5) * (a + b) + c.k1 * c.k5;
  return limited_pair((c.k0 * a + c.k1) * a * under_b * both,
                      (c.k0 * b + c.k1) * b * under_a * both, (b - a) * slope * both);
}

SKYLAPSE_INLINE void expose_in(const ColourRows& in, const RationalCurve& curve, float scale,
                               int count, const OpponentRows& out) {
  const ColourRows rows = in;
  const OpponentRows result = out;
  const RationalCurve c = curve;
  SKYLAPSE_INDEPENDENT_TURNS
  for (int i = 0; i < count; ++i) {
    const Shown r = toned(rows.first[0][i], rows.second[0][i], c, scale);
    const Shown g = toned(rows.first[1][i], rows.second[1][i], c, scale);
    const Shown b = toned(rows.first[2][i], rows.second[2][i], c, scale);
    store_opponent(result, i, {r.mean, g.mean, b.mean}, {r.difference, g.difference, b.difference});
  }
}

/// Beyond this colours are no longer told apart; its square is finite.
constexpr float kReinhardLimit = 1e15f;

SKYLAPSE_INLINE float reinhard_input(float v, float scale) {
  v *= scale;
  return v < kReinhardLimit ? v : kReinhardLimit;
}

SKYLAPSE_INLINE float luminance_of(float r, float g, float b) {
  return 0.2126f * r + 0.7152f * g + 0.0722f * b;
}

/// `mean`, `change` of the luminance; `both` is 1 / ((1 + La) (1 + Lb)).
SKYLAPSE_INLINE Shown reinhard(float a, float b, float mean, float change, float under_a,
                               float under_b, float both) {
  const float difference = ((b - a) * (1.0f + mean) - 0.5f * (a + b) * change) * both;
  return limited_pair(a * under_b * both, b * under_a * both, difference);
}

SKYLAPSE_INLINE void expose_reinhard_in(const ColourRows& in, float scale, int count,
                                        const OpponentRows& out) {
  const ColourRows rows = in;
  const OpponentRows result = out;
  SKYLAPSE_INDEPENDENT_TURNS
  for (int i = 0; i < count; ++i) {
    const float ar = reinhard_input(rows.first[0][i], scale);
    const float ag = reinhard_input(rows.first[1][i], scale);
    const float ab = reinhard_input(rows.first[2][i], scale);
    const float br = reinhard_input(rows.second[0][i], scale);
    const float bg = reinhard_input(rows.second[1][i], scale);
    const float bb = reinhard_input(rows.second[2][i], scale);
    const float la = luminance_of(ar, ag, ab), lb = luminance_of(br, bg, bb);
    const float change = luminance_of(br - ar, bg - ag, bb - ab), mean = 0.5f * (la + lb);
    const float under_a = 1.0f + la, under_b = 1.0f + lb;
    const float both = 1.0f / (under_a * under_b);
    const Shown r = reinhard(ar, br, mean, change, under_a, under_b, both);
    const Shown g = reinhard(ag, bg, mean, change, under_a, under_b, both);
    const Shown b = reinhard(ab, bb, mean, change, under_a, under_b, both);
    store_opponent(result, i, {r.mean, g.mean, b.mean}, {r.difference, g.difference, b.difference});
  }
}

/// How far the lengths of vectors m + d/2 and m - d/2 are apart.
SKYLAPSE_INLINE float length_change(float mx, float my, float dx, float dy) {
  const float ax = mx - 0.5f * dx, ay = my - 0.5f * dy;
  const float bx = mx + 0.5f * dx, by = my + 0.5f * dy;
  const float lengths = std::sqrt(ax * ax + ay * ay) + std::sqrt(bx * bx + by * by);
  const float squares = 2.0f * std::fabs(mx * dx + my * dy);
  return squares / (lengths > kSmallestNormal ? lengths : kSmallestNormal);
}

/// E = dE_c^(1 - dE_f) (2020, Eq. 12 ff.).
SKYLAPSE_INLINE void errors_in(const FilteredRows& in, int count, float* worst) {
  const FilteredRows rows = in;
  using Field = FilteredRows::Field;
  SKYLAPSE_INDEPENDENT_TURNS
  for (int i = 0; i < count; ++i) {
    const auto mean = [&](Field f) __attribute__((always_inline)) { return rows.mean[f][i]; };
    const auto change = [&](Field f) __attribute__((always_inline)) {
      return rows.difference[f][i];
    };
    const float colour = colour_error(
        {mean(Field::luminance), mean(Field::red_green), mean(Field::blue_yellow)},
        {change(Field::luminance), change(Field::red_green), change(Field::blue_yellow)});
    const float edge = length_change(mean(Field::edge_x), mean(Field::edge_y),
                                     change(Field::edge_x), change(Field::edge_y));
    const float point = length_change(mean(Field::point_x), mean(Field::point_y),
                                      change(Field::point_x), change(Field::point_y));
    constexpr float kRootHalf = 0.707106781f;
    const float feature = limited(std::sqrt(kRootHalf * (edge > point ? edge : point)));
    // A colour difference of 0 is 0, whatever the features: not 0^0.
    const float error = colour > kSmallestNormal ? power_of(colour, 1.0f - feature) : 0.0f;
    worst[i] = error > worst[i] ? error : worst[i];
  }
}

struct Narrow {
  static void decode_srgb(float* values, int count) { decode_srgb_in(values, count); }
  static void oppose(const ColourRows& in, int count, const OpponentRows& out) {
    oppose_in(in, count, out);
  }
  static void expose(const ColourRows& in, const RationalCurve& curve, float scale, int count,
                     const OpponentRows& out) {
    expose_in(in, curve, scale, count, out);
  }
  static void expose_reinhard(const ColourRows& in, float scale, int count,
                              const OpponentRows& out) {
    expose_reinhard_in(in, scale, count, out);
  }
  static void filter_even(const float* const* rows, const float* taps, int radius, int count,
                          bool add, float* out) {
    filter_even_in<Float4>(rows, taps, radius, count, add, out);
  }
  static void filter_odd(const float* const* rows, const float* taps, int radius, int count,
                         float* out) {
    filter_odd_in<Float4>(rows, taps, radius, count, out);
  }
  static void errors(const FilteredRows& in, int count, float* worst) {
    errors_in(in, count, worst);
  }
};

struct Wide {
  SKYLAPSE_V3 static void decode_srgb(float* values, int count) { decode_srgb_in(values, count); }
  SKYLAPSE_V3 static void oppose(const ColourRows& in, int count, const OpponentRows& out) {
    oppose_in(in, count, out);
  }
  SKYLAPSE_V3 static void expose(const ColourRows& in, const RationalCurve& curve, float scale,
                                 int count, const OpponentRows& out) {
    expose_in(in, curve, scale, count, out);
  }
  SKYLAPSE_V3 static void expose_reinhard(const ColourRows& in, float scale, int count,
                                          const OpponentRows& out) {
    expose_reinhard_in(in, scale, count, out);
  }
  SKYLAPSE_V3 static void filter_even(const float* const* rows, const float* taps, int radius,
                                      int count, bool add, float* out) {
    filter_even_in<Float8>(rows, taps, radius, count, add, out);
  }
  SKYLAPSE_V3 static void filter_odd(const float* const* rows, const float* taps, int radius,
                                     int count, float* out) {
    filter_odd_in<Float8>(rows, taps, radius, count, out);
  }
  SKYLAPSE_V3 static void errors(const FilteredRows& in, int count, float* worst) {
    errors_in(in, count, worst);
  }
};

struct Widest {
  SKYLAPSE_V4 static void decode_srgb(float* values, int count) { decode_srgb_in(values, count); }
  SKYLAPSE_V4 static void oppose(const ColourRows& in, int count, const OpponentRows& out) {
    oppose_in(in, count, out);
  }
  SKYLAPSE_V4 static void expose(const ColourRows& in, const RationalCurve& curve, float scale,
                                 int count, const OpponentRows& out) {
    expose_in(in, curve, scale, count, out);
  }
  SKYLAPSE_V4 static void expose_reinhard(const ColourRows& in, float scale, int count,
                                          const OpponentRows& out) {
    expose_reinhard_in(in, scale, count, out);
  }
  SKYLAPSE_V4 static void filter_even(const float* const* rows, const float* taps, int radius,
                                      int count, bool add, float* out) {
    filter_even_in<Float16>(rows, taps, radius, count, add, out);
  }
  SKYLAPSE_V4 static void filter_odd(const float* const* rows, const float* taps, int radius,
                                     int count, float* out) {
    filter_odd_in<Float16>(rows, taps, radius, count, out);
  }
  SKYLAPSE_V4 static void errors(const FilteredRows& in, int count, float* worst) {
    errors_in(in, count, worst);
  }
};

template <class Set>
constexpr Kernels kKernels{Set::decode_srgb, Set::oppose,     Set::expose, Set::expose_reinhard,
                           Set::filter_even, Set::filter_odd, Set::errors};

}  // namespace

const Kernels* kernels_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::baseline:
      return &kKernels<Narrow>;
#if SKYLAPSE_X86
    case InstructionSet::v3:
      return __builtin_cpu_supports("x86-64-v3") ? &kKernels<Wide> : nullptr;
    case InstructionSet::v4:
      return __builtin_cpu_supports("x86-64-v4") ? &kKernels<Widest> : nullptr;
#endif
    default:
      return nullptr;
  }
}

const Kernels& best_kernels() {
  static const Kernels* const best = [] {
    for (const auto set : {InstructionSet::v4, InstructionSet::v3})
      if (const Kernels* kernels = kernels_of(set)) return kernels;
    return kernels_of(InstructionSet::baseline);
  }();
  return *best;
}

}  // namespace skylapse::image::flip_internal
