#pragma once
// The loops that run once per pixel of a sliced sky, written for the vectoriser and compiled for
// several instruction sets. Directions are double, so that the elevation over the horizon keeps its
// digits where the limb seen from space is a tenth of a degree thick; angles and radiance are
// float.
#include <cstdint>

namespace skylapse::sky::bruneton::kernel {

/// One node of the table: R, G, B of the smooth light and one unused, then of the aerosol light
/// (times the constant of its phase function) and one unused.
inline constexpr int kNodeFloats = 8;
/// Pixels handled at a time; their coordinates stay in the first-level cache.
inline constexpr int kBlock = 256;

/// Where pixels of a block fall in the table, and the shape of the aerosol's phase function there:
/// (1 + nu^2) / (1 + g^2 - 2 g nu)^1.5.
struct BlockCoordinates {
  alignas(64) float row_fraction[kBlock];
  alignas(64) float column_fraction[kBlock];
  alignas(64) float phase[kBlock];
  alignas(64) float over_horizon[kBlock];         // rad; negative: on the ground
  alignas(64) std::int32_t table_offset[kBlock];  // in floats
};

/// Row at the elevation e [rad] over or below the horizon:
/// sqrt(factor e / (bend + sqrt(bend^2 + slope e))). See SliceGrid::share.
struct RowPlaces {
  float factor;  // 2 (rows of the half - 1)^2 / span
  float bend;
  float slope;  // 4 (1 - bend) / span
};

/// The slice's axes and its sun.
struct Shape {
  double horizon_sine, horizon_cosine;  // of the zenith angle of the geometric horizon
  double sun_sine, sun_cosine;          // of the sun's zenith angle
  double phase_a, phase_b;              // 1 + g^2 and 2 g
  RowPlaces sky, ground;
  float top;      // rad over the horizon: black above (a camera in space)
  float columns;  // azimuths - 1
  int half;       // rows of a half
  int azimuths;
  int black_row;  // this row of the table and the next are 0
};

struct Vec3d {
  double x, y, z;
};

/// Pixels of one image row before an eye: pixel i of a block looks along (x, y, z) with
/// x = x_first + i x_step and y in the image plane. The axes are level towards the sun, level
/// across (to either side), and up, in the camera's axes.
struct RowView {
  double x_first, x_step, y;
  Vec3d along, across, up;
  float near;  // count pixels nearer to the horizon than this [rad]
};

/// Fills the coordinates of `count` pixels; returns how many are nearer to the horizon than
/// view.near. Plane: direction (x, y, 1) / length. Fisheyes: as hosek_wilkie/sky_kernel.h.
/// Error of the coordinates: 2e-7 relative in elevation over the horizon and in azimuth (tested).
int plane_coordinates(const Shape& shape, const RowView& view, int count, BlockCoordinates& out);
int equidistant_coordinates(const Shape& shape, const RowView& view, double k, int count,
                            BlockCoordinates& out);
int equisolid_coordinates(const Shape& shape, const RowView& view, double k, int count,
                          BlockCoordinates& out);
int stereographic_coordinates(const Shape& shape, const RowView& view, double k, int count,
                              BlockCoordinates& out);

/// Any lens: unit vectors in the camera's axes.
int direction_coordinates(const Shape& shape, const RowView& view, const Vec3d* directions,
                          int count, BlockCoordinates& out);

/// Reads the table at the block's coordinates into interleaved RGB; negative values become 0.
void look_up(const float* table, int azimuths, const BlockCoordinates& place, int count,
             float* rgb);

/// A row of constant elevation: column i of the image falls at `offset` (floats) and `fraction` of
/// a single row of the table, cos_azimuth from the sun.
struct LevelRow {
  const std::int32_t* offset;
  const float* fraction;
  const double* cos_azimuth;
  double nu_base, nu_slope;  // nu = nu_base + nu_slope * cos_azimuth
  double phase_a, phase_b;   // as Shape
};
/// Reads `row` at the columns [first, first + count); adds `share` times the radiance, not below 0,
/// to rgb, which is that of the first of them.
void add_level_row(const float* row, const LevelRow& level, float share, int first, int count,
                   float* rgb);

}  // namespace skylapse::sky::bruneton::kernel
