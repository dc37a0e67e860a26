#pragma once
// What a slice needs that does not depend on the sun: a list of samples for each of its rows. A
// camera that stays where it is makes them once.
#include <vector>

#include "sky/bruneton/physics_buffers.h"
#include "sky/bruneton/rays.h"

namespace skylapse::sky::bruneton {

/// As in shaders/shared/list_sample.glsl.
struct ListSample {
  float sun_scale, nu_scale, mu, height;
  float slab, height_weight, unused[2];
};
/// As in shaders/entry/slice.comp (std430).
struct SliceRowBlock {
  float ray[24];  // text::Ray
  float mu, whole[3];
  int first, count, first_piece, unused;
};
struct SunSample {
  float sun_scale, nu_scale, height, view[3], rayleigh, aerosol;
};

struct SliceLists {
  std::vector<SliceRowBlock> rows;
  /// Gauss nodes of the march: what sunlight needs there, and what multiple scattering does. Apart,
  /// for a ray that is cut at the planet's shadow uses the second list alone.
  std::vector<SunSample> samples;
  std::vector<ListSample> places;
  /// [sample][group]: transmittance * scattering * length.
  std::vector<glm::dvec4> weights;
  /// Columns from the camera along each piece, kProfileNodes a piece: evenly in s, distance from
  /// the piece's lower end = length * s^2.
  static constexpr int kProfileNodes = 128;
  std::vector<glm::vec4> profiles;
};

/// `data` holds the coordinates of the tables and the march's Gauss nodes. Rows outside `window`
/// have no samples.
SliceLists slice_lists(const Columns& columns, const PhysicsData& data, const Settings& settings,
                       double height_km, const SliceGrid& grid, const SliceWindow& window);

/// Where a place lies in the source table of these settings.
ListSample list_sample(double sun_scale, double nu_scale, double mu, double height_km,
                       double height_coordinate, double zenith_coordinate,
                       const Settings& settings);

}  // namespace skylapse::sky::bruneton
