#pragma once
// How the double text reads its tables; part of physics.h.
#include <algorithm>

#include "sky/bruneton/physics.h"

namespace skylapse::sky::bruneton::text {

/// The node below a coordinate, of `last + 1` nodes, and the weight of the one above.
struct Between {
  int node;
  double weight;
};
inline Between between(double coordinate, int last) {
  const int node = std::clamp(int(coordinate), 0, std::max(last - 1, 0));
  return {node, std::clamp(coordinate - node, 0.0, last > 0 ? 1.0 : 0.0)};
}

template <int GroupCount>
vec3 Physics<GroupCount>::fetch_columns(vec2 texel) const {
  const Between x = between(texel.x, kColumnHeights - 1);
  const Between y = between(texel.y, kColumnDistances - 1);
  const vec3* at = data_.columns + size_t(x.node) * kColumnDistances + y.node;
  const vec3* above = at + kColumnDistances;
  return (at[0] * (1 - y.weight) + at[1] * y.weight) * (1 - x.weight) +
         (above[0] * (1 - y.weight) + above[1] * y.weight) * x.weight;
}

template <int GroupCount>
vec4 Physics<GroupCount>::fetch_source(int g, vec3 texel) const {
  const Settings& size = data_.tables->settings;
  const float* source = data_.tables->source[first_ + g].data();
  const Between x = between(texel.x, size.table_azimuths - 1);
  const Between y = between(texel.y, size.sun_rows() - 1);
  const Between z = between(texel.z, size.table_zeniths * size.heights - 1);
  const size_t step_x = size.table_azimuths > 1 ? 4 : 0;
  const size_t step_y = 4 * size_t(size.table_azimuths), step_z = step_y * size.sun_rows();
  const float* corner = source + z.node * step_z + y.node * step_y + x.node * size_t(4);
  const auto row = [&](const float* at) {
    const vec4 a(at[0], at[1], at[2], at[3]);
    const float* next = at + step_x;
    return a + (vec4(next[0], next[1], next[2], next[3]) - a) * x.weight;
  };
  const auto plane = [&](const float* at) {
    return row(at) * (1 - y.weight) + row(at + step_y) * y.weight;
  };
  return z.weight > 0 ? plane(corner) * (1 - z.weight) + plane(corner + step_z) * z.weight
                      : plane(corner);
}

template <int GroupCount>
vec4 Physics<GroupCount>::fetch_ground(int g, Real row) const {
  if (data_.tables == nullptr || data_.tables->ground_irradiance.empty()) return vec4(0);
  const float* values = data_.tables->ground_irradiance[first_ + g].data();
  const Between y = between(row, data_.tables->settings.sun_rows() - 1);
  const float* at = values + 4 * size_t(y.node);
  return vec4(at[0], at[1], at[2], at[3]) * (1 - y.weight) +
         vec4(at[4], at[5], at[6], at[7]) * y.weight;
}

}  // namespace skylapse::sky::bruneton::text
