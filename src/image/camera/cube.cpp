#include "image/camera/cube.h"

#include <algorithm>

#include "image/camera/planar.h"

namespace skylapse::image {
namespace {

// The camera frame's axes, and OpenEXR's in it.
const glm::dvec3 kRight{1, 0, 0}, kUp{0, 1, 0}, kAhead{0, 0, 1};

/// Column and row of each face in units of the face's size.
CubeFaceOrigin cell_of(CubeLayout layout, CubeFace face) {
  const int index = static_cast<int>(face);
  if (layout == CubeLayout::horizontal_strip) return {index, 0};
  if (layout == CubeLayout::vertical_strip) return {0, index};
  if (layout == CubeLayout::vertical_cross && face == CubeFace::neg_z) return {1, 3};
  switch (face) {
    case CubeFace::pos_x:
      return {0, 1};
    case CubeFace::pos_z:
      return {1, 1};
    case CubeFace::neg_x:
      return {2, 1};
    case CubeFace::neg_z:
      return {3, 1};
    case CubeFace::pos_y:
      return {1, 0};
    case CubeFace::neg_y:
      break;
  }
  return {1, 2};
}

CubeFace face_of(const glm::dvec3& d) {
  const glm::dvec3 a = glm::abs(d);
  if (a.z >= a.x && a.z >= a.y) return d.z > 0 ? CubeFace::pos_z : CubeFace::neg_z;
  if (a.x >= a.y) return d.x > 0 ? CubeFace::neg_x : CubeFace::pos_x;  // X is to the left
  return d.y > 0 ? CubeFace::pos_y : CubeFace::neg_y;
}

}  // namespace

CubeFaceAxes cube_face_axes(CubeLayout layout, CubeFace face) {
  const bool cross = layout == CubeLayout::cross || layout == CubeLayout::vertical_cross;
  const double turn = cross ? -1 : 1;  // of the upper and the lower face
  const double turn_behind = layout == CubeLayout::vertical_cross ? -1 : 1;
  switch (face) {
    case CubeFace::pos_x:
      return {-kRight, kAhead, kUp};
    case CubeFace::neg_x:
      return {kRight, -kAhead, kUp};
    case CubeFace::pos_y:
      return {kUp, -turn * kRight, turn * kAhead};
    case CubeFace::neg_y:
      return {-kUp, -turn * kRight, -turn * kAhead};
    case CubeFace::pos_z:
      return {kAhead, kRight, kUp};
    case CubeFace::neg_z:
      break;
  }
  return {-kAhead, -turn_behind * kRight, turn_behind * kUp};
}

int cube_face_size(const Camera& camera) {
  switch (camera.cube_layout) {
    case CubeLayout::horizontal_strip:
      return camera.height;
    case CubeLayout::vertical_strip:
      return camera.width;
    case CubeLayout::vertical_cross:
      return camera.width / 3;
    case CubeLayout::cross:
      break;
  }
  return camera.height / 3;
}

CubeFaceOrigin cube_face_origin(const Camera& camera, CubeFace face) {
  const int n = cube_face_size(camera);
  const auto [column, row] = cell_of(camera.cube_layout, face);
  return {column * n, row * n};
}

std::optional<CubeFace> cube_face_at(const Camera& camera, PixelPosition position) {
  const int n = cube_face_size(camera);
  for (const CubeFace face : kCubeFaces) {
    const auto [x, y] = cube_face_origin(camera, face);
    const bool last_column = x + n == camera.width, last_row = y + n == camera.height;
    const bool in_x =
        position.x >= x && (position.x < x + n || (last_column && position.x == x + n));
    const bool in_y = position.y >= y && (position.y < y + n || (last_row && position.y == y + n));
    if (in_x && in_y) return face;
  }
  return {};
}

Direction<CameraFrame> cube_ray(const Camera& camera, CubeFace face, PixelPosition position) {
  const int n = cube_face_size(camera);
  const auto [x, y] = cube_face_origin(camera, face);
  const auto axes = cube_face_axes(camera.cube_layout, face);
  const double s = 2 * (position.x - x) / n - 1, t = 1 - 2 * (position.y - y) / n;
  return Direction<CameraFrame>::from_vector(axes.forward + s * axes.right + t * axes.up);
}

PixelPosition cube_position(const Camera& camera, const Direction<CameraFrame>& direction) {
  const int n = cube_face_size(camera);
  const CubeFace face = face_of(direction.vec());
  const auto [x, y] = cube_face_origin(camera, face);
  const auto axes = cube_face_axes(camera.cube_layout, face);
  const double depth = glm::dot(axes.forward, direction.vec());
  const double s = glm::dot(axes.right, direction.vec()) / depth;
  const double t = glm::dot(axes.up, direction.vec()) / depth;
  return {std::clamp(x + 0.5 * n * (1 + s), double(x), std::nextafter(double(x + n), 0.0)),
          std::clamp(y + 0.5 * n * (1 - t), double(y), std::nextafter(double(y + n), 0.0))};
}

double cube_solid_angle_sr(const Camera& camera, CubeFace face, int x, int y) {
  const int n = cube_face_size(camera);
  const auto origin = cube_face_origin(camera, face);
  const double s = 2.0 * (x - origin.x) / n - 1, t = 2.0 * (y - origin.y) / n - 1;
  return solid_angle_sr({s, s + 2.0 / n, t, t + 2.0 / n});
}

}  // namespace skylapse::image
