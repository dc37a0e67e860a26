#include "sky/bruneton/slice_kernel.h"

#include <cmath>
#include <cstring>

#include "core/vector_kernel.h"
#include "sky/bruneton/slice_angles.h"

namespace skylapse::sky::bruneton::kernel {
namespace {

using Float4 = float __attribute__((vector_size(16)));
using Float8 = float __attribute__((vector_size(32)));

constexpr float kInversePi = 0.318309886184f;

SKYLAPSE_INLINE Float8 load(const float* p) {
  Float8 v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

/// Smooth light plus the aerosol's, not below 0.
SKYLAPSE_INLINE Float4 radiance(Float8 node, float phase) {
  const Float4 smooth = __builtin_shufflevector(node, node, 0, 1, 2, 3);
  const Float4 aerosol = __builtin_shufflevector(node, node, 4, 5, 6, 7);
  const Float4 sum = smooth + phase * aerosol;
  const Float4 zero{};
  return sum > zero ? sum : zero;
}

SKYLAPSE_INLINE float phase_shape(double nu, double a, double b) {
  // The difference is taken in double: at g = 0.99 it is 1e-4 on the sun, of terms near 2.
  const auto x = static_cast<float>(a - b * nu);
  const auto n = static_cast<float>(nu);
  return (1.0f + n * n) / (x * std::sqrt(x));
}

SKYLAPSE_INLINE float square_of_row(const RowPlaces& places, float e) {
  return places.factor * e /
         (places.bend + std::sqrt(places.bend * places.bend + places.slope * e));
}

/// Direction (unit) by its level part towards the sun, its level part across, its height.
SKYLAPSE_INLINE int place_direction(const Shape& shape, float near, double along, double across,
                                    double up, int i, BlockCoordinates& out) {
  const double level = std::sqrt(along * along + across * across);
  const auto sine = static_cast<float>(up * shape.horizon_sine - level * shape.horizon_cosine);
  const auto cosine = static_cast<float>(up * shape.horizon_cosine + level * shape.horizon_sine);
  const float over = fast_atan2(sine, cosine);
  const float distance = std::fabs(over);
  // The half that does not count adds exactly 0. A choice between the halves' constants would be
  // one branch for all of them to gcc, which keeps it from vectorising the loop.
  const float up_part = 0.5f * (distance + over), down_part = 0.5f * (distance - over);
  const float s =
      std::sqrt(square_of_row(shape.sky, up_part) + square_of_row(shape.ground, down_part));
  // Read here: a load under a condition keeps the loop from being vectorised.
  const int half = shape.half, black_row = shape.black_row;
  int row = static_cast<int>(s);
  row = row < half - 2 ? row : half - 2;
  const float row_fraction = s - static_cast<float>(row);
  row += over < 0.0f ? half : 0;
  row = over > shape.top ? black_row : row;
  const float azimuth =
      fast_atan2(static_cast<float>(std::fabs(across)), static_cast<float>(along));
  const float c = power_two_thirds(azimuth * kInversePi) * shape.columns;
  int column = static_cast<int>(c);
  column = column < shape.azimuths - 2 ? column : shape.azimuths - 2;
  out.row_fraction[i] = row_fraction < 1.0f ? row_fraction : 1.0f;
  out.column_fraction[i] = c - static_cast<float>(column);
  out.phase[i] =
      phase_shape(along * shape.sun_sine + up * shape.sun_cosine, shape.phase_a, shape.phase_b);
  out.over_horizon[i] = over;
  out.table_offset[i] = (row * shape.azimuths + column) * kNodeFloats;
  return distance < near ? 1 : 0;
}

SKYLAPSE_INLINE int place_camera_direction(const Shape& shape, const RowView& view, double x,
                                           double y, double z, int i, BlockCoordinates& out) {
  return place_direction(shape, view.near, x * view.along.x + y * view.along.y + z * view.along.z,
                         x * view.across.x + y * view.across.y + z * view.across.z,
                         x * view.up.x + y * view.up.y + z * view.up.z, i, out);
}

/// `half` gives sin(theta/2) / r and cos(theta/2) for r^2.
template <class HalfAngle>
SKYLAPSE_INLINE int fisheye_coordinates(const Shape& shape, const RowView& view, int count,
                                        BlockCoordinates& out, HalfAngle half) {
  int near = 0;
  for (int i = 0; i < count; ++i) {
    const double x = view.x_first + static_cast<double>(i) * view.x_step;
    const double r2 = x * x + view.y * view.y;
    double s_over_r, c;
    half(r2, s_over_r, c);
    const double k = 2.0 * s_over_r * c;
    near += place_camera_direction(shape, view, k * x, k * view.y,
                                   1.0 - 2.0 * s_over_r * s_over_r * r2, i, out);
  }
  return near;
}

}  // namespace

SKYLAPSE_CLONES
int plane_coordinates(const Shape& shape, const RowView& view, int count, BlockCoordinates& out) {
  int near = 0;
  for (int i = 0; i < count; ++i) {
    const double x = view.x_first + static_cast<double>(i) * view.x_step;
    const double k = 1.0 / std::sqrt(1.0 + x * x + view.y * view.y);
    near += place_camera_direction(shape, view, k * x, k * view.y, k, i, out);
  }
  return near;
}

SKYLAPSE_CLONES
int equidistant_coordinates(const Shape& shape, const RowView& view, double k, int count,
                            BlockCoordinates& out) {
  // Taylor series of sin(t)/t and cos(t) in t^2, t = theta/2 up to 90 deg: next terms below 2e-13.
  constexpr double kSine[] = {
      -1. / 6,         1. / 120,         -1. / 5040,           1. / 362880,
      -1. / 39916800., 1. / 6227020800., -1. / 1307674368000., 1. / 355687428096000.};
  constexpr double kCosine[] = {-1. / 2,
                                1. / 24,
                                -1. / 720,
                                1. / 40320,
                                -1. / 3628800,
                                1. / 479001600,
                                -1. / 87178291200.,
                                1. / 20922789888000.,
                                -1. / 6402373705728000.};
  return fisheye_coordinates(
      shape, view, count,
      out, [&](double r2, double& s_over_r, double& c) __attribute__((always_inline)) {
        const double u = k * k * r2;
        double sine = 0, cosine = 0;
        for (int n = 7; n >= 0; --n) sine = (sine + kSine[n]) * u;
        for (int n = 8; n >= 0; --n) cosine = (cosine + kCosine[n]) * u;
        s_over_r = k * (1.0 + sine);
        c = 1.0 + cosine;
      });
}

SKYLAPSE_CLONES
int equisolid_coordinates(const Shape& shape, const RowView& view, double k, int count,
                          BlockCoordinates& out) {
  return fisheye_coordinates(
      shape, view, count,
      out, [k](double r2, double& s_over_r, double& c) __attribute__((always_inline)) {
        const double c2 = 1.0 - k * k * r2;
        c = std::sqrt(c2 > 0.0 ? c2 : 0.0);
        s_over_r = k;
      });
}

SKYLAPSE_CLONES
int stereographic_coordinates(const Shape& shape, const RowView& view, double k, int count,
                              BlockCoordinates& out) {
  return fisheye_coordinates(
      shape, view, count,
      out, [k](double r2, double& s_over_r, double& c) __attribute__((always_inline)) {
        c = 1.0 / std::sqrt(1.0 + k * k * r2);
        s_over_r = k * c;
      });
}

SKYLAPSE_CLONES
int direction_coordinates(const Shape& shape, const RowView& view, const Vec3d* directions,
                          int count, BlockCoordinates& out) {
  int near = 0;
  for (int i = 0; i < count; ++i)
    near += place_camera_direction(shape, view, directions[i].x, directions[i].y, directions[i].z,
                                   i, out);
  return near;
}

SKYLAPSE_CLONES
void look_up(const float* table, int azimuths, const BlockCoordinates& place, int count,
             float* rgb) {
  const int stride = azimuths * kNodeFloats;
  const auto pixel = [&](int i) __attribute__((always_inline)) {
    const float* p = table + place.table_offset[i];
    const float f = place.column_fraction[i], g = place.row_fraction[i];
    const Float8 a = load(p), b = load(p + stride);
    const Float8 low = a + f * (load(p + kNodeFloats) - a);
    const Float8 high = b + f * (load(p + stride + kNodeFloats) - b);
    return radiance(low + g * (high - low), place.phase[i]);
  };
  // All but the last store four floats, of which the next pixel overwrites one.
  for (int i = 0; i + 1 < count; ++i) {
    const Float4 v = pixel(i);
    std::memcpy(rgb + 3 * i, &v, sizeof v);
  }
  const Float4 last = pixel(count - 1);
  std::memcpy(rgb + 3 * (count - 1), &last, 3 * sizeof(float));
}

SKYLAPSE_CLONES
void add_level_row(const float* row, const LevelRow& level, float share, int first, int count,
                   float* rgb) {
  alignas(64) float phase[kBlock];
  for (int begin = 0; begin < count; begin += kBlock) {
    const int end = count - begin < kBlock ? count : begin + kBlock;
    for (int i = begin; i < end; ++i)
      phase[i - begin] = phase_shape(level.nu_base + level.nu_slope * level.cos_azimuth[first + i],
                                     level.phase_a, level.phase_b);
    for (int i = begin; i < end; ++i) {
      const float* p = row + level.offset[first + i];
      const Float8 a = load(p);
      const Float8 node = a + level.fraction[first + i] * (load(p + kNodeFloats) - a);
      const Float4 v = share * radiance(node, phase[i - begin]);
      for (int c = 0; c < 3; ++c) rgb[3 * i + c] += v[c];
    }
  }
}

}  // namespace skylapse::sky::bruneton::kernel
