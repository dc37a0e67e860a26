#include "plan/effects/view_reach.h"

#include <algorithm>
#include <cmath>

namespace skylapse::plan {
namespace {

using image::Camera;
using image::Projection;

/// Points along the edge of what the camera sees: the image's sides, or the fisheye circle.
std::vector<image::PixelPosition> outline(const Camera& camera) {
  constexpr int kPoints = 64;
  const double w = camera.width, h = camera.height;
  std::vector<image::PixelPosition> points;
  for (int i = 0; i <= kPoints; ++i) {
    const double t = double(i) / kPoints;
    if (camera.projection == Projection::perspective) {
      points.insert(points.end(), {{t * w, h}, {t * w, 0}, {0, t * h}, {w, t * h}});
    } else {
      const double radius = 0.4999 * std::min(w, h);
      const Angle a = t * 360 * deg;
      points.push_back({0.5 * w + radius * sin(a), 0.5 * h + radius * cos(a)});
    }
  }
  return points;
}

bool sees_all(const Camera& camera) { return image::sees_whole_sphere(camera.projection); }

/// Directions on the circle of radius `r` around `centre`, and the centre.
std::vector<Direction<Enu>> circle(const Direction<Enu>& centre, Angle r) {
  const glm::dvec3 side = glm::normalize(glm::cross(
      centre.vec(), std::abs(centre.z()) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
  const glm::dvec3 up = glm::cross(side, centre.vec());
  std::vector<Direction<Enu>> points{centre};
  for (int i = 0; i < 16; ++i) {
    const Angle a = i * 22.5 * deg;
    points.push_back(Direction<Enu>::from_vector(centre.vec() * cos(r) +
                                                 (side * cos(a) + up * sin(a)) * sin(r)));
  }
  return points;
}

}  // namespace

PixelSides pixel_sides(const Camera& camera) {
  constexpr int kSamples = 9;
  double smallest = 4, largest = 0;
  const auto look = [&](int x, int y) {
    const double side = std::sqrt(image::pixel_solid_angle(camera, x, y).in(sr));
    if (side == 0) return;
    smallest = std::min(smallest, side), largest = std::max(largest, side);
  };
  for (int j = 0; j < kSamples; ++j)
    for (int i = 0; i < kSamples; ++i)
      look(int(int64_t(camera.width - 1) * i / (kSamples - 1)),
           int(int64_t(camera.height - 1) * j / (kSamples - 1)));
  look(camera.width / 2, camera.height / 2);
  return {smallest * rad, std::max(smallest, largest) * rad};
}

ViewReach view_reach(const Camera& camera) {
  if (sees_all(camera)) return {};
  ViewReach reach{90 * deg, -90 * deg};
  for (const image::PixelPosition& position : outline(camera)) {
    const auto d = image::direction_at(camera, position);
    if (!d) continue;
    reach.lowest = std::min(reach.lowest, elevation(*d));
    reach.highest = std::max(reach.highest, elevation(*d));
  }
  const Angle margin = 2 * pixel_sides(camera).largest;
  reach.lowest = std::max(-90 * deg, reach.lowest - margin);
  reach.highest = std::min(90 * deg, reach.highest + margin);
  // Elevation has no extremes on the sphere but zenith and nadir.
  if (image::position_of(camera, enu_direction(0 * deg, -90 * deg))) reach.lowest = -90 * deg;
  if (image::position_of(camera, enu_direction(0 * deg, 90 * deg))) reach.highest = 90 * deg;
  return reach;
}

bool disc_in_picture(const Camera& camera, const Direction<Enu>& centre, Angle reach) {
  if (sees_all(camera)) return true;
  for (const auto& point : circle(centre, reach))
    if (image::position_of(camera, point)) return true;
  // A picture smaller than the disc may lie within it.
  for (const image::PixelPosition& position : outline(camera))
    if (const auto d = image::direction_at(camera, position))
      if (separation(*d, centre) < reach) return true;
  return false;
}

}  // namespace skylapse::plan
