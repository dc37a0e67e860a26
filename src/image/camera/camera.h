#pragma once
// Cameras: which direction each pixel looks along, and back.
#include <glm/glm.hpp>
#include <optional>

#include "core/frames.h"
#include "core/quantity.h"

namespace skylapse::image {

enum class Projection {
  perspective,
  fisheye_equidistant,
  fisheye_equisolid,
  fisheye_stereographic,
  lat_long,
  cube,
  octahedral,   // equal-area square, pbrt-4's: camera/octahedral.h
  mirror_ball,  // photograph of a mirror ball: camera/fisheye.h
};

/// Whether a camera of this projection sees every direction, whatever its field of view.
constexpr bool sees_whole_sphere(Projection p) {
  return p == Projection::lat_long || p == Projection::cube || p == Projection::octahedral ||
         p == Projection::mirror_ball;
}

/// Whether such an image stands upright: only its heading can be turned.
constexpr bool stands_upright(Projection p) {
  return sees_whole_sphere(p) && p != Projection::mirror_ball;
}

/// Strips hold +X -X +Y -Y +Z -Z, each face oriented as OpenEXR's ENVMAP_CUBE: seen from inside,
/// not mirrored. (OpenGL's own faces are mirrored in right-handed axes: docs/conventions.md.)
/// The crosses join at their edges: left (+X), ahead (+Z), right (-X) side by side, +Y above and -Y
/// below ahead, both turned by half a turn against the strips; behind (-Z) is the fourth of the
/// row, or, turned by half a turn, the fourth of the column; the rest is blank.
enum class CubeLayout {
  horizontal_strip,  // 6n x n
  vertical_strip,    // n x 6n, as OpenEXR stores a cube
  cross,             // 4n x 3n
  vertical_cross,    // 3n x 4n
};

/// A camera and its image size. Lat-long and cube images use the OpenEXR axes
/// X = west, Y = up, Z = north, turned about the vertical by the camera's heading.
struct Camera {
  Projection projection = Projection::perspective;
  int width = 0;
  int height = 0;
  /// Perspective: full horizontal angle, (0, 180) deg. Fisheye: full angle across the image
  /// circle, whose diameter is the shorter side; up to 360 deg (stereographic below 360).
  Angle field_of_view = 90 * deg;
  CubeLayout cube_layout = CubeLayout::vertical_strip;
  /// Columns: the camera's right, up and forward axes in east-north-up, orthonormal with
  /// determinant -1 (right x up points backward). Lat-long, cube and octahedral: up is the zenith
  /// and forward the heading (of the image centre; octahedral: of its lower edge). Default: looking
  /// north, upright.
  glm::dmat3 camera_to_enu{1, 0, 0, 0, 0, 1, 0, 1, 0};
};

/// Camera orientation looking at `azimuth` and `elevation`, rolled clockwise by `roll` as seen
/// from behind. At elevation +-90 deg the image's upper edge is the limit of that azimuth:
/// looking straight up with azimuth 0 (north), the upper edge points south.
glm::dmat3 look_at(Angle azimuth, Angle elevation, Angle roll);

/// Where a camera looks.
struct Look {
  Angle azimuth, elevation;  // of its forward axis
  Angle roll;                // (-180, 180] deg
};

/// Inverse of look_at: look_at of the result has these axes, to rounding. Looking straight up or
/// down, where azimuth and roll turn about one axis, the azimuth is 0.
Look look_of(const glm::dmat3& camera_to_enu);

Direction<CameraFrame> to_camera_frame(const Camera& camera, const Direction<Enu>& direction);
Direction<Enu> to_enu(const Camera& camera, const Direction<CameraFrame>& direction);

struct PixelPosition {
  double x = 0;  // in pixels from the left edge; the centre of column i is i + 0.5
  double y = 0;  // in pixels from the top edge
};

/// Direction seen at a position of the image; nothing outside a fisheye's or a ball's circle or on
/// the blank parts of a cross.
std::optional<Direction<Enu>> direction_at(const Camera& camera, PixelPosition position);

/// Where a direction falls; nothing if the camera does not see it.
std::optional<PixelPosition> position_of(const Camera& camera, const Direction<Enu>& direction);

/// Solid angle of the pixel in column x and row y, to 1e-6 relative wherever the projection is
/// smooth over the pixel; 0 outside the picture. A pixel cut by a fisheye's circle belongs to the
/// picture, as a whole, if its centre does: the pixels that direction_at lets a renderer fill.
SolidAngle pixel_solid_angle(const Camera& camera, int x, int y);

/// Share of a pixel above the horizon: clamp((elevation - horizon) / side + 1/2), side = sqrt(solid
/// angle), from the elevation of the pixel's centre. A pixel of no size is above or below. The
/// horizon of a camera above the ground lies below elevation 0 by its dip.
double horizon_coverage(Angle elevation, SolidAngle pixel, Angle horizon = {});

}  // namespace skylapse::image
