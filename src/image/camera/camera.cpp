#include "image/camera/camera.h"

#include <algorithm>

#include "image/camera/cube.h"
#include "image/camera/fisheye.h"
#include "image/camera/lat_long.h"
#include "image/camera/octahedral.h"
#include "image/camera/perspective.h"

namespace skylapse::image {
namespace {

// Rounding of a direction on the picture's very edge must not push it out.
constexpr double kEdgeTolerance = 1e-9;

bool in_frame(const Camera& camera, PixelPosition p) {
  return p.x >= 0 && p.x <= camera.width && p.y >= 0 && p.y <= camera.height;
}

/// The position, moved onto the frame if it is outside by no more than rounding.
std::optional<PixelPosition> onto_frame(const Camera& camera, PixelPosition p) {
  const double w = camera.width, h = camera.height;
  const PixelPosition inside{std::clamp(p.x, 0.0, w), std::clamp(p.y, 0.0, h)};
  const bool near = std::abs(p.x - inside.x) <= kEdgeTolerance * w &&
                    std::abs(p.y - inside.y) <= kEdgeTolerance * h;
  if (!near) return {};
  return inside;
}

bool in_circle(const Camera& camera, PixelPosition p) {
  return fisheye_radius_at(camera, p) <= 1 + kEdgeTolerance;
}

std::optional<Direction<CameraFrame>> ray(const Camera& camera, PixelPosition position) {
  switch (camera.projection) {
    case Projection::perspective:
      return perspective_ray(camera, position);
    case Projection::lat_long:
      return lat_long_ray(camera, position);
    case Projection::cube: {
      const auto face = cube_face_at(camera, position);
      if (!face) return {};
      return cube_ray(camera, *face, position);
    }
    case Projection::octahedral:
      return octahedral_ray(camera, position);
    case Projection::mirror_ball:
    case Projection::fisheye_equidistant:
    case Projection::fisheye_equisolid:
    case Projection::fisheye_stereographic:
      break;
  }
  if (!in_circle(camera, position)) return {};
  const FisheyeCircle circle = fisheye_circle(camera);
  // A full sphere ends at the circle: come back onto it from a rounding error outside.
  const double r = std::max(1.0, fisheye_radius_at(camera, position));
  return fisheye_ray(camera, {circle.centre_x_px + (position.x - circle.centre_x_px) / r,
                              circle.centre_y_px + (position.y - circle.centre_y_px) / r});
}

}  // namespace

glm::dmat3 look_at(Angle azimuth, Angle elevation, Angle roll) {
  const double sa = sin(azimuth), ca = cos(azimuth);
  const double se = sin(elevation), ce = cos(elevation);
  const glm::dvec3 forward{sa * ce, ca * ce, se};
  const glm::dvec3 level_right{ca, -sa, 0};
  const glm::dvec3 level_up{-sa * se, -ca * se, ce};
  return {cos(roll) * level_right - sin(roll) * level_up,
          cos(roll) * level_up + sin(roll) * level_right, forward};
}

Look look_of(const glm::dmat3& camera_to_enu) {
  const auto forward = Direction<Enu>::from_vector(camera_to_enu[2]);
  Look look{skylapse::azimuth(forward), skylapse::elevation(forward), {}};
  const glm::dmat3 level = look_at(look.azimuth, look.elevation, Angle{});
  look.roll =
      atan2_angle(-glm::dot(camera_to_enu[0], level[1]), glm::dot(camera_to_enu[0], level[0]));
  return look;
}

Direction<CameraFrame> to_camera_frame(const Camera& camera, const Direction<Enu>& direction) {
  return Direction<CameraFrame>::from_vector(direction.vec() * camera.camera_to_enu);
}

Direction<Enu> to_enu(const Camera& camera, const Direction<CameraFrame>& direction) {
  return Direction<Enu>::from_vector(camera.camera_to_enu * direction.vec());
}

std::optional<Direction<Enu>> direction_at(const Camera& camera, PixelPosition position) {
  if (!in_frame(camera, position)) return {};  // NaN too
  const auto d = ray(camera, position);
  if (!d) return {};
  return to_enu(camera, *d);
}

std::optional<PixelPosition> position_of(const Camera& camera, const Direction<Enu>& direction) {
  const auto d = to_camera_frame(camera, direction);
  switch (camera.projection) {
    case Projection::perspective: {
      const auto p = perspective_position(camera, d);
      return p ? onto_frame(camera, *p) : std::nullopt;
    }
    case Projection::lat_long:
      return lat_long_position(camera, d);
    case Projection::cube:
      return cube_position(camera, d);
    case Projection::octahedral:
      return octahedral_position(camera, d);
    case Projection::mirror_ball:
    case Projection::fisheye_equidistant:
    case Projection::fisheye_equisolid:
    case Projection::fisheye_stereographic:
      break;
  }
  const auto p = fisheye_position(camera, d);
  if (!p || !in_circle(camera, *p)) return {};
  return onto_frame(camera, *p);
}

SolidAngle pixel_solid_angle(const Camera& camera, int x, int y) {
  if (x < 0 || y < 0 || x >= camera.width || y >= camera.height) return {};
  const PixelPosition centre{x + 0.5, y + 0.5};
  switch (camera.projection) {
    case Projection::perspective:
      return perspective_solid_angle_sr(camera, x, y) * sr;
    case Projection::lat_long:
      return lat_long_solid_angle_sr(camera, y) * sr;
    case Projection::cube: {
      const auto face = cube_face_at(camera, centre);
      return (face ? cube_solid_angle_sr(camera, *face, x, y) : 0.0) * sr;
    }
    case Projection::octahedral:
      return octahedral_solid_angle_sr(camera) * sr;
    case Projection::mirror_ball:
    case Projection::fisheye_equidistant:
    case Projection::fisheye_equisolid:
    case Projection::fisheye_stereographic:
      break;
  }
  return (in_circle(camera, centre) ? fisheye_solid_angle_sr(camera, x, y) : 0.0) * sr;
}

double horizon_coverage(Angle elevation, SolidAngle pixel, Angle horizon) {
  const double side = std::sqrt(pixel.in(sr));
  const double over = (elevation - horizon).in(rad);
  if (!(side > 0)) return over > 0 ? 1 : 0;
  return std::clamp(over / side + 0.5, 0.0, 1.0);
}

}  // namespace skylapse::image
