#include "sky/bruneton/directions.h"

#include <cmath>

namespace skylapse::sky::bruneton {

DirectionRows direction_rows(Geometry geometry, const Settings& settings, double height_km) {
  DirectionRows rows;
  rows.up = settings.directions_up;
  const double horizon = geometry.horizon_mu(height_km);
  const auto add = [&](int count, double width, double sign) {
    for (const glm::dvec2& node : gauss_nodes(count)) {
      rows.mu.push_back(horizon + sign * width * node.x * std::sqrt(node.x));
      rows.weight.push_back(width * 1.5 * std::sqrt(node.x) * node.y);
    }
  };
  add(settings.directions_up, 1 - horizon, 1);
  add(settings.directions_down, 1 + horizon, -1);
  // d(s^1.5) is no polynomial: make each half's weights sum to its width exactly.
  const auto scale = [&](size_t begin, size_t end, double width) {
    double sum = 0;
    for (size_t i = begin; i < end; ++i) sum += rows.weight[i];
    for (size_t i = begin; i < end; ++i) rows.weight[i] *= width / sum;
  };
  scale(0, rows.up, 1 - horizon);
  scale(rows.up, rows.mu.size(), 1 + horizon);
  return rows;
}

double height_node(const atmosphere::Medium& medium, const Settings& settings, int i) {
  const std::vector<HeightKnot> knots = height_knots(medium, settings);
  size_t knot = 0;
  while (knot + 2 < knots.size() && knots[knot + 1].node <= i) ++knot;
  const HeightKnot &from = knots[knot], &to = knots[knot + 1];
  const double share =
      from.share + (to.share - from.share) * (i - from.node) / double(to.node - from.node);
  return medium.top_height_km * std::pow(share, kHeightExponent);
}

}  // namespace skylapse::sky::bruneton
