#include "sky/bruneton/slice_window.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "sky/bruneton/slice_image.h"
#include "sky/facet.h"

namespace skylapse::sky::bruneton {
namespace {

constexpr double kPi = std::numbers::pi;

/// Directions along the edge of a camera with one facet, in order.
std::vector<glm::dvec3> outline(const image::Camera& camera, const Facet& facet) {
  constexpr int kPoints = 1024;
  const double x = 0.5 * camera.width / facet.unit_px, y = 0.5 * camera.height / facet.unit_px;
  std::vector<glm::dvec3> points;
  points.reserve(kPoints + 1);
  for (int i = 0; i <= kPoints; ++i) {
    if (facet.lens != Facet::Lens::plane) {
      const double turn = 2 * kPi * i / kPoints;
      points.push_back(facet.direction(std::cos(turn), std::sin(turn)));
      continue;
    }
    const int side = std::min(i / (kPoints / 4), 3);
    const double t = 2 * (double(i) / (kPoints / 4) - side) - 1;
    const glm::dvec2 corners[] = {{t * x, y}, {x, -t * y}, {-t * x, -y}, {-x, t * y}};
    points.push_back(facet.direction(corners[side].x, corners[side].y));
  }
  return points;
}

/// What a camera may look along, in radians: zenith angles, and azimuths from the sun to either
/// side.
struct View {
  double nearest_zenith = kPi, farthest_zenith = 0;
  double nearest_azimuth = kPi, farthest_azimuth = 0;

  void see_all_azimuths() { nearest_azimuth = 0, farthest_azimuth = kPi; }
  /// All directions within `margin` of one.
  void add(double zenith, double azimuth, double margin) {
    nearest_zenith = std::min(nearest_zenith, std::max(zenith - margin, 0.0));
    farthest_zenith = std::max(farthest_zenith, std::min(zenith + margin, kPi));
    // From a pole a circle of the margin's radius spans this much azimuth.
    const double sine = std::sin(margin) / std::max(std::sin(zenith), 1e-30);
    if (margin >= kPi / 2 || sine >= 1) return see_all_azimuths();
    const double turn = std::asin(sine);
    nearest_azimuth = std::min(nearest_azimuth, std::max(azimuth - turn, 0.0));
    farthest_azimuth = std::max(farthest_azimuth, std::min(azimuth + turn, kPi));
  }
};

View view_of(const image::Camera& camera, const Facet& facet, const Direction<Enu>& sun) {
  const glm::dvec3 along = level_direction(sun), across(along.y, -along.x, 0);
  const std::vector<glm::dvec3> points = outline(camera, facet);
  // Between two points of the edge, and two pixels beyond it, for those at the horizon are means;
  // the last term is the rounding of the pixel loop.
  double step = 0;
  for (size_t i = 1; i < points.size(); ++i)
    step = std::max(step, glm::length(points[i] - points[i - 1]));
  const double margin = 1.01 * step + (kMeanPixels + 0.5) * facet.largest_pixel_side() + 1e-5;
  // What holds no pole has its extremes on its edge: of the zenith angle, and of the azimuth too,
  // since the half circles of azimuth 0 and 180 deg end in the poles.
  View view;
  for (const glm::dvec3& point : points) {
    const double level_along = glm::dot(point, along), level_across = glm::dot(point, across);
    view.add(std::atan2(std::hypot(level_along, level_across), point.z),
             std::atan2(std::abs(level_across), level_along), margin);
  }
  for (const double pole : {0.0, kPi})
    if (image::position_of(camera, enu_direction(0 * deg, (kPi / 2 - pole) * rad)))
      view.add(pole, 0, margin);
  return view;
}

/// Nodes for the curves between those about the places [low, high] of an axis: one more on each
/// side, whose values give the slopes.
NodeRange nodes_between(double low, double high, int nodes) {
  const int first = std::min(int(low), nodes - 2);
  const int last = std::max(int(std::ceil(high)), first + 1);
  return {std::max(first - 1, 0), std::min(last + 2, nodes)};
}

}  // namespace

SliceWindow window_of(const image::Camera& camera, const SliceGrid& grid,
                      const Direction<Enu>& sun) {
  if (sees_whole_sphere(camera.projection)) return whole_window(grid);
  const View view = view_of(camera, facets_of(camera).front(), sun);
  const int half = grid.zeniths / 2;
  const double over_low = grid.horizon_zenith_rad - view.farthest_zenith;
  const double over_high = grid.horizon_zenith_rad - view.nearest_zenith;
  const auto place = [&](double over) { return grid.share(over) * (half - 1); };
  SliceWindow window;
  if (over_high >= 0 && over_low <= grid.sky_span_rad)
    window.sky = nodes_between(place(std::max(over_low, 0.0)), place(over_high), half);
  // 0 belongs to the sky half: the ground half begins at the least number below.
  constexpr double kBelow = -std::numeric_limits<double>::min();
  if (over_low < 0)
    window.ground = nodes_between(place(std::min(over_high, kBelow)), place(over_low), half);
  if (window.sky.empty() && window.ground.empty()) return window;
  const auto column = [&](double azimuth) {
    return std::pow(azimuth / kPi, 2.0 / 3) * (grid.azimuths - 1);
  };
  window.azimuths =
      nodes_between(column(view.nearest_azimuth), column(view.farthest_azimuth), grid.azimuths);
  return window;
}

}  // namespace skylapse::sky::bruneton
