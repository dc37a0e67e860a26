#include "image/camera/octahedral.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skylapse::image {
namespace {

constexpr double kPi = std::numbers::pi;

/// Place on the unit octant: r from the pole (0) to the horizon (1), and the share t of the quarter
/// turn from the first axis to the second.
struct Polar {
  double r, t;
};

/// cos(elevation) cos(turn), cos(elevation) sin(turn), sin(elevation); r and t may lie outside
/// [0, 1], where the same formula goes on.
glm::dvec3 on_octant(Polar p) {
  const double level = p.r * std::sqrt(std::max(0.0, 2 - p.r * p.r));
  const double turn = p.t * kPi / 2;
  return {level * std::cos(turn), level * std::sin(turn), (1 - p.r) * (1 + p.r)};
}

/// In pbrt's axes to the camera's: right, up, forward.
glm::dvec3 to_camera(const glm::dvec3& v) { return {v.x, v.z, v.y}; }

struct Square {
  double u, v;
};

Square square_of(const Camera& camera, PixelPosition position) {
  return {2 * position.x / camera.width - 1, 2 * position.y / camera.height - 1};
}

/// Into [-1, 1] over the folds of the edges.
Square folded(Square s) {
  if (std::abs(s.u) > 1) s = {std::copysign(2 - std::abs(s.u), s.u), -s.v};
  if (std::abs(s.v) > 1) s = {-s.u, std::copysign(2 - std::abs(s.v), s.v)};
  return s;
}

/// Place of u and v in an octant's own triangle, whose right angle is the pole.
Polar polar_in(Octant octant, Square s) {
  const double u = octant.u * s.u, v = octant.v * s.v;
  const double first = octant.up > 0 ? u : 1 - v, second = octant.up > 0 ? v : 1 - u;
  const double r = first + second;
  return {r, second / r};
}

}  // namespace

glm::dvec3 octahedral_direction(double u, double v) {
  const double a = std::abs(u), b = std::abs(v);
  const double over = 1 - (a + b);
  // The fold of the lower half, as pbrt: r = 1 - |over|, and b - a is the same in both halves.
  const double r = 1 - std::abs(over);
  const double t = r == 0 ? 0 : 0.5 * ((b - a) / r + 1);
  const glm::dvec3 d = on_octant({r, t});
  return to_camera({std::copysign(d.x, u), std::copysign(d.y, v), std::copysign(d.z, over)});
}

Direction<CameraFrame> octahedral_ray(const Camera& camera, PixelPosition position) {
  const Square s = folded(square_of(camera, position));
  return Direction<CameraFrame>::from_vector(octahedral_direction(s.u, s.v));
}

PixelPosition octahedral_position(const Camera& camera, const Direction<CameraFrame>& direction) {
  const double x = direction.x(), y = direction.z(), z = direction.y();
  // 1 - |z| without cancelling near the poles.
  const double r = std::sqrt((x * x + y * y) / (1 + std::abs(z)));
  const double t = std::atan2(std::abs(y), std::abs(x)) / (kPi / 2);
  double u = r * (1 - t), v = r * t;
  if (z < 0) {
    const double lower_u = 1 - v;
    v = 1 - u;
    u = lower_u;
  }
  const auto place = [](double s, int size) { return std::clamp(0.5 * (s + 1), 0.0, 1.0) * size; };
  return {place(std::copysign(u, x), camera.width), place(std::copysign(v, y), camera.height)};
}

double octahedral_solid_angle_sr(const Camera& camera) {
  return 4 * kPi / (double(camera.width) * camera.height);
}

Octant octant_at(const Camera& camera, PixelPosition position) {
  const Square s = square_of(camera, position);
  return {s.u < 0 ? -1 : 1, s.v < 0 ? -1 : 1, std::abs(s.u) + std::abs(s.v) > 1 ? -1 : 1};
}

Direction<CameraFrame> octant_ray(const Camera& camera, Octant octant, PixelPosition position) {
  const Polar p = polar_in(octant, square_of(camera, position));
  // Around a pole the formula would turn too far with a step: there the picture itself goes on.
  constexpr double kFarthestTurn = 1;
  if (!(p.r > 0) || p.r * p.r >= 2 || !(std::abs(p.t - 0.5) < 0.5 + kFarthestTurn))
    return octahedral_ray(camera, position);
  const glm::dvec3 d = on_octant(p);
  return Direction<CameraFrame>::from_vector(
      to_camera({octant.u * d.x, octant.v * d.y, octant.up * d.z}));
}

Angle octahedral_pixel_extent(const Camera& camera, const Direction<CameraFrame>& direction,
                              Angle radius) {
  const double level2 = direction.x() * direction.x() + direction.z() * direction.z();
  const double r2 = level2 / (1 + std::abs(direction.y()));
  // About a pole the disc meets every turn.
  const bool pole = std::sqrt(level2) < 2 * sin(radius);
  const double t =
      pole ? 1 : std::atan2(std::abs(direction.z()), std::abs(direction.x())) / (kPi / 2);
  const double a2 = 4 / (2 - r2), b = kPi / 2 * std::sqrt(2 - r2) * std::max(t, 1 - t);
  return std::sqrt(a2 + b * b) * 2 / std::min(camera.width, camera.height) * rad;
}

}  // namespace skylapse::image
