#include "sky/bruneton/columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/parallel.h"
#include "sky/bruneton/twin.h"

namespace skylapse::sky::bruneton {
namespace {

std::vector<double> all_breaks(const atmosphere::Medium& medium) {
  std::set<double> breaks;
  for (const atmosphere::DensityProfile* profile :
       {&medium.rayleigh, &medium.aerosol, &medium.ozone})
    for (const double h : profile->breaks_km(medium.top_height_km)) breaks.insert(h);
  return {breaks.begin(), breaks.end()};
}

const std::vector<glm::dvec2>& rule(int nodes) {
  static const std::vector<glm::dvec2> k16 = gauss_nodes(16), k32 = gauss_nodes(32),
                                       k64 = gauss_nodes(64);
  return nodes <= 16 ? k16 : nodes <= 32 ? k32 : k64;
}

}  // namespace

Paths::Paths(const atmosphere::Medium& medium)
    : data_(physics_data(medium, Settings{}, 2)), breaks_(all_breaks(medium)) {}

glm::dvec3 Paths::columns(double h, double mu, double from, double to, int nodes) const {
  Geometry geometry(data_);
  const double R = data_.air.bottom_radius;
  const double b = (R + h) * mu;
  const double lowest = std::clamp(-b, from, to);
  std::vector<double> cuts{from, lowest, to};
  for (const double level : breaks_) {
    const double d = b * b + (level - h) * (2 * R + level + h);
    if (d < 0) continue;
    for (const double t : {-b - std::sqrt(d), -b + std::sqrt(d)})
      if (t > from && t < to) cuts.push_back(t);
  }
  std::sort(cuts.begin(), cuts.end());
  glm::dvec3 sum(0);
  for (size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double length = cuts[i + 1] - cuts[i];
    if (length <= 0) continue;
    const bool rising = cuts[i] >= lowest;
    for (const glm::dvec2& node : rule(nodes)) {
      const double away = length * node.x * node.x;
      const double t = rising ? cuts[i] + away : cuts[i + 1] - away;
      sum += geometry.densities(geometry.height_along(h, mu, t)) * (2 * node.x * node.y * length);
    }
  }
  return sum;
}

glm::dvec3 Paths::columns_to_top(double h, double mu) const {
  return columns(h, mu, 0, geometry().distance_to_top(h, mu));
}

Columns::Columns(const atmosphere::Medium& medium)
    : medium_(medium), paths_(medium), nodes_(size_t(kColumnHeights) * kColumnDistances) {
  const Paths smooth(without_layers(medium));
  Geometry geometry = smooth.geometry();
  const double R = medium.bottom_radius_km, H = medium.top_height_km;
  parallel_for_ranges(kColumnHeights, 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const double share = double(i) / (kColumnHeights - 1);
      const double h = H * share * share;
      const double shortest = H - h;
      const double longest = std::sqrt(h * (2 * R + h)) + geometry.air.horizon_length;
      for (int j = 0; j < kColumnDistances; ++j) {
        const double d = shortest + (longest - shortest) * j / (kColumnDistances - 1);
        // (R + H)^2 = r^2 + d^2 + 2 r d mu, written with heights; the zenith where d is 0.
        const double mu = d > 0 ? ((H - h) * (2 * R + H + h) - d * d) / (2 * (R + h) * d) : 1;
        nodes_[i * kColumnDistances + j] = smooth.columns(h, std::clamp(mu, -1.0, 1.0), 0, d);
      }
    }
  });
}

std::shared_ptr<const Columns> make_columns(const atmosphere::Medium& medium) {
  return std::make_shared<const Columns>(medium);
}

}  // namespace skylapse::sky::bruneton
