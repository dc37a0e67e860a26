#pragma once
// What the twin's questions share: the bands of a medium, marched in groups of four.
#include <algorithm>
#include <vector>

#include "sky/bruneton/columns.h"
#include "sky/bruneton/physics.h"
#include "sky/bruneton/rays.h"

namespace skylapse::sky::bruneton {

/// Four numbers a group, cut to the bands there are.
struct Bands {
  std::vector<double> values;
  size_t count;
  void add(const glm::dvec4& group) {
    for (int c = 0; c < 4 && values.size() < count; ++c) values.push_back(group[c]);
  }
};

/// The same data for another number of samples a piece.
inline PhysicsData march_data(const PhysicsData& base, int samples) {
  PhysicsData data = base;
  if (int(data.gauss.size()) == samples) return data;
  data.air.march_samples = samples;
  data.gauss = gauss_nodes(samples);
  return data;
}

/// Calls body(text, first group) for all groups, marching up to four of them together.
template <class Body>
void for_groups(const PhysicsData& data, const Body& body) {
  const int groups = int(data.groups.size());
  int first = 0;
  for (; first + 4 <= groups; first += 4) {
    text::Physics<4> physics(data, first);
    body(physics, first);
  }
  for (; first < groups; ++first) {
    text::Physics<1> physics(data, first);
    body(physics, first);
  }
}

/// Columns from h to the sun's centre, or along the horizon if that is below it.
inline glm::dvec3 columns_to_sun(const Columns& columns, double h, double mu_s) {
  Geometry geometry = columns.paths().geometry();
  const text::Ray ray = make_ray(columns, h, std::max(mu_s, geometry.horizon_mu(h)), RaySide::sky);
  return columns.paths().columns(ray.height, ray.mu, 0, ray.length);
}

}  // namespace skylapse::sky::bruneton
