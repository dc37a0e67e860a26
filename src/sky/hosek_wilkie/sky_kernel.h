#pragma once
// The loops that run once per pixel, in float, written for the vectoriser; compiled for several
// instruction sets, the best of which the machine has is picked when the program starts.
//
// A frame's sky is tabulated over two coordinates in which it is smooth:
//   q  of the angle gamma to the sun: sqrt(1 - cos gamma) up to 90 deg, 2 - sqrt(1 + cos gamma)
//      beyond; 0 at the sun, 1 at 90 deg, 2 at the antisolar point, linear in gamma near both ends
//   w  = sqrt(cos theta) of the view's zenith angle: 0 on the horizon, 1 in the zenith
// Along q, cubic polynomials on kIntervals equal intervals; along w, rows of such polynomials.
#include <cstdint>

namespace skylapse::sky::hosek_wilkie::kernel {

inline constexpr int kIntervals = 64;
/// One interval: the coefficients of four powers of t in [0, 1], each for R, G, B and one unused.
inline constexpr int kIntervalFloats = 16;
/// The order they are stored in: (k0, k2) + t (k1, k3) is one multiplication of eight values.
inline constexpr int kPowers[4] = {0, 2, 1, 3};
inline constexpr int kRowFloats = kIntervals * kIntervalFloats;
/// Rows along w, linear in between.
inline constexpr int kRowSteps = 256;
/// Pixels handled at a time; their coordinates stay in the first-level cache.
inline constexpr int kBlock = 256;

/// The polynomials of each band (already times its colour), to be summed with the bands' horizon
/// gradients as weights. Constant terms are double: they cancel against each other.
struct BandPolynomials {
  const float* coefficients;  // [kIntervals][band][kIntervalFloats]
  const double* constants;    // [kIntervals][band][4]
  int band_count;
};

/// One row: sum over bands of weight * polynomial, plus `offset` (4 values) in the constant term.
void combine_bands(const BandPolynomials& bands, const double* weights, const double* offset,
                   float* row);

/// Where the pixels of a block fall in the table.
struct BlockCoordinates {
  alignas(64) float q_fraction[kBlock];
  alignas(64) float w_fraction[kBlock];
  alignas(64) std::int32_t table_offset[kBlock];  // in floats
  alignas(64) float sine[kBlock];                 // of the view's elevation
};

struct Vec3f {
  float x, y, z;
};

/// Pixels of one image row before an eye: pixel i of a block looks along (x, y, z) with
/// x = x_first + i x_step and y in the image plane. Sun and zenith are in the same axes.
struct RowView {
  float x_first, x_step, y;
  Vec3f sun, zenith;
  float low_sine;  // count pixels below this sine of elevation
};

/// Fills the coordinates of `count` pixels; returns how many lie below view.low_sine.
/// Plane: direction (x, y, 1) / length.
int plane_coordinates(const RowView& view, int count, BlockCoordinates& out);
/// Fisheyes: `k` is theta_max / 2 (equidistant), sin(theta_max / 2) or tan(theta_max / 2); x and y
/// in radii of the image circle.
int equidistant_coordinates(const RowView& view, float k, int count, BlockCoordinates& out);
int equisolid_coordinates(const RowView& view, float k, int count, BlockCoordinates& out);
int stereographic_coordinates(const RowView& view, float k, int count, BlockCoordinates& out);

/// Any lens: unit vectors in the camera's axes.
int direction_coordinates(const RowView& view, const Vec3f* directions, int count,
                          BlockCoordinates& out);

/// Reads the table at the block's coordinates into interleaved RGB; negative values become 0.
void look_up(const float* table, const BlockCoordinates& place, int count, float* rgb);

/// A row of constant elevation: 1 - cos gamma = near_base + slope * near[i] and
/// 1 + cos gamma = far_base + slope * far[i]; see sky_image.cpp.
struct LevelRow {
  float near_base, far_base, slope;
  const float* near;
  const float* far;
};

/// Where the pixels of a block fall in a single row of the table.
struct RowCoordinates {
  alignas(64) float q_fraction[kBlock];
  alignas(64) std::int32_t table_offset[kBlock];
};
/// Coordinates of the pixels [first, first + count) of a level row.
void level_coordinates(const LevelRow& level, int first, int count, RowCoordinates& out);
/// As look_up, from the one row.
void look_up_row(const float* row, const RowCoordinates& place, int count, float* rgb);

struct Colour {
  float r, g, b;
};
void fill_pixels(int count, Colour colour, float* rgb);

}  // namespace skylapse::sky::hosek_wilkie::kernel
