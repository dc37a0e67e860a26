#include "sky/bruneton/rays.h"

#include <algorithm>
#include <cmath>

#include "sky/bruneton/optical_cuts.h"

namespace skylapse::sky::bruneton {
namespace {

/// From a camera above the air to the point where its ray enters; length stays 0 if it does not.
bool enter(text::Ray& ray, double R, double H, double h, double mu) {
  const double b = (R + h) * mu;
  const double d = b * b - (h - H) * (2 * R + h + H);  // (R + H)^2 less the impact parameter's
  if (mu >= 0 || d <= 0) return false;
  ray.skipped = (h - H) * (2 * R + h + H) / (-b + std::sqrt(d));
  ray.height = H;
  ray.mu = std::max(-std::sqrt(d) / (R + H), -1.0);  // straight down it may round past -1
  return true;
}

}  // namespace

text::Ray make_ray(const Columns& columns, double height_km, double mu, RaySide side,
                   double limit_km) {
  Geometry geometry = columns.paths().geometry();
  const double R = geometry.air.bottom_radius, H = geometry.air.top_height;
  text::Ray ray{};
  ray.camera_radius = R + height_km;
  ray.height = std::min(height_km, H);
  ray.mu = mu;
  const bool to_ground = side == RaySide::ground ||
                         (side == RaySide::by_direction && mu < geometry.horizon_mu(height_km));
  if (height_km > H && !enter(ray, R, H, height_km, mu)) return ray;
  const double whole = to_ground ? geometry.distance_to_ground(ray.height, ray.mu)
                                 : geometry.distance_to_top(ray.height, ray.mu);
  ray.length = std::clamp(limit_km - ray.skipped, 0.0, whole);
  ray.hits_ground = to_ground && ray.length >= whole ? 1 : 0;
  ray.lowest = std::clamp(-(R + ray.height) * ray.mu, 0.0, ray.length);
  const std::vector<double> cuts = march_cuts(columns, ray.height, ray.mu, ray.length);
  ray.cut_count = double(cuts.size());
  std::copy(cuts.begin(), cuts.end(), ray.cuts);
  return ray;
}

double slice_zenith(const SliceGrid& grid, int row) {
  const int half = grid.zeniths / 2;
  const double s = double(row < half ? row : row - half) / (half - 1);
  return row < half ? grid.horizon_zenith_rad - grid.elevation(s, true)
                    : grid.horizon_zenith_rad + grid.elevation(s, false);
}

std::vector<SliceRow> slice_rows(const Columns& columns, double height_km, const SliceGrid& grid) {
  std::vector<SliceRow> rows;
  for (int j = 0; j < grid.zeniths; ++j) {
    const double zenith = slice_zenith(grid, j);
    const double mu = std::cos(zenith);
    const RaySide side = j < grid.zeniths / 2 ? RaySide::sky : RaySide::ground;
    rows.push_back({zenith, mu, make_ray(columns, height_km, mu, side)});
  }
  return rows;
}

}  // namespace skylapse::sky::bruneton
