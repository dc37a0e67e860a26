#pragma once
// View rays for the march of march.glsl, made in double.
#include <vector>

#include "sky/bruneton/columns.h"
#include "sky/bruneton/sky_slice.h"

namespace skylapse::sky::bruneton {

/// Which side of the horizon a ray belongs to: by its direction, or set where the direction is the
/// horizon itself up to rounding.
enum class RaySide { by_direction, sky, ground };

/// The part inside the air of the ray from `height_km` (>= 0, may be above the air) towards the
/// zenith cosine `mu`, at most `limit_km` long from the camera (hits_ground is 0 if that is short
/// of the ground). Length 0 where it meets no air.
text::Ray make_ray(const Columns& columns, double height_km, double mu,
                   RaySide side = RaySide::by_direction, double limit_km = 1e30);

/// One row of a slice: its direction at the camera and its ray.
struct SliceRow {
  double zenith_rad, mu;
  text::Ray ray;
};
std::vector<SliceRow> slice_rows(const Columns& columns, double height_km, const SliceGrid& grid);

/// Zenith angle of row j of a grid.
double slice_zenith(const SliceGrid& grid, int row);

}  // namespace skylapse::sky::bruneton
