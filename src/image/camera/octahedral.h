#pragma once
// Equal-area octahedral map: the whole sphere on a square, every pixel the same solid angle.
// Source   Clarberg 2008, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD", as used by
//          pbrt-4 (Pharr, Jakob & Humphreys 2023, "Physically Based Rendering", 3.8.3).
// Axes     pbrt's x, y, z are the camera's right, forward and up: with heading north that is east,
//          north and up. x grows with the columns and y with the rows; the zenith is the middle,
//          the horizon the square that stands on its corner, the nadir all four corners. Looking up
//          at the middle, the heading is at the lower edge: heading north, the edges' middles are
//          south above, east to the right, north below and west to the left. Nothing is mirrored.
// Edges    The outer edges are folded in their middles: (W, y) shows what (W, H - y) shows.
#include "image/camera/camera.h"

namespace skylapse::image {

/// Direction (unit) in the camera frame at u and v in [-1, 1], right and down from the middle.
glm::dvec3 octahedral_direction(double u, double v);

/// Direction of any position; beyond an edge it is that of the other side of the fold.
Direction<CameraFrame> octahedral_ray(const Camera& camera, PixelPosition position);

/// Where a direction falls. Straight down, which the four corners show, the lower right is taken.
PixelPosition octahedral_position(const Camera& camera, const Direction<CameraFrame>& direction);

double octahedral_solid_angle_sr(const Camera& camera);

/// Derivatives of the direction are at most this, in radians per unit of u and v: with the
/// derivatives' columns (a, -b t) and (a, b (1 - t)), a in [sqrt 2, 2], b = pi / a, t in [0, 1],
/// the larger singular value is 3.07 at the horizon's corners.
inline constexpr double kOctahedralStretch = 3.08;

// ---- Octants: the map is smooth in each of eight triangles, and only continuous between them.

/// Signs of u and v, and of the height: the part of the sphere that one triangle shows.
struct Octant {
  int u, v, up;  // +1 or -1
  bool operator==(const Octant&) const = default;
};

/// The triangle that holds a position of the picture; its edges belong to one of them.
Octant octant_at(const Camera& camera, PixelPosition position);

/// As octahedral_ray in the octant, going on beyond its edges by the same formula. There the
/// formula steps from pixel centre to pixel centre of the neighbouring octants, but near a pole and
/// across the horizon, where it only comes near them.
Direction<CameraFrame> octant_ray(const Camera& camera, Octant octant, PixelPosition position);

/// The larger of the angles that a pixel's two sides span at a direction.
Angle octahedral_pixel_extent(const Camera& camera, const Direction<CameraFrame>& direction,
                              Angle radius);

}  // namespace skylapse::image
