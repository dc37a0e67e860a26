#pragma once
// The rays from the points of the tables, sampled once for all suns: what the orders of scattering
// sum along.
#include <vector>

#include "sky/bruneton/columns.h"
#include "sky/bruneton/directions.h"

namespace skylapse::sky::bruneton {

/// A place on a ray, and what a lookup there needs.
struct MarchSample {
  double distance_km, height_km, mu;  // mu: of the ray's direction there
  /// mu_s there = sun_scale * mu_s + nu_scale * nu: r / r' and t / r'.
  double sun_scale, nu_scale;
  double height_coordinate, zenith_coordinate;  // in the source table
  glm::dvec3 columns;                           // from the point to here [km]
};

struct MarchRay {
  int first = 0, count = 0;  // samples
  bool hits_ground = false;
  double length_km = 0;
  double ground_sun_scale = 0, ground_nu_scale = 0;  // as above, at the ground
};

/// Rays in the order [height][direction row]; weights in the order [sample][band], band count that
/// of the medium.
struct MarchLists {
  std::vector<DirectionRows> rows;  // per height
  std::vector<MarchRay> rays;
  std::vector<MarchSample> samples;
  /// transmittance * scattering coefficient * dt of each component, scaled so that over a ray
  /// transmittance * extinction * dt sums to 1 - T(end): thick air neither makes nor loses light.
  std::vector<double> rayleigh_weight, aerosol_weight;
  std::vector<double> ground_transmittance;  // [ray][band]; 0 where the ray does not hit it
  int bands = 0;

  [[nodiscard]] double scattering_weight(int sample, int band) const {
    const size_t i = size_t(sample) * bands + band;
    return rayleigh_weight[i] + aerosol_weight[i];
  }
};

/// `samples` Gauss nodes a piece; pieces end at the lowest point and at set optical depths.
MarchLists march_lists(const Columns& columns, const Settings& settings, int samples);

}  // namespace skylapse::sky::bruneton
