#include "sky/bruneton/march_lists.h"

#include <algorithm>
#include <cmath>

#include "sky/bruneton/optical_cuts.h"

namespace skylapse::sky::bruneton {
namespace {

struct Builder {
  const Columns& columns;
  Geometry geometry;
  PhysicsData coordinates_data;  // with the settings' table sizes
  Geometry coordinates;
  std::vector<glm::dvec2> gauss;
  MarchLists lists;

  Builder(const Columns& table, const Settings& settings, int samples)
      : columns(table),
        geometry(table.paths().geometry()),
        coordinates_data(physics_data(table.medium(), settings, 2)),
        coordinates(coordinates_data),
        gauss(gauss_nodes(samples)) {
    lists.bands = int(table.medium().bands.size());
  }

  MarchSample sample_at(double h, double mu, double t) {
    const double r = geometry.radius_of(h);
    const double there = geometry.height_along(h, mu, t), r_there = geometry.radius_of(there);
    const double mu_there = std::clamp((r * mu + t) / r_there, -1.0, 1.0);
    return {t,
            there,
            mu_there,
            r / r_there,
            t / r_there,
            coordinates.height_coordinate(there),
            coordinates.zenith_coordinate(mu_there),
            {}};
  }

  /// Samples of one piece; `steps` receives their shares of the path.
  void add_piece(double h, double mu, double begin, double end, bool rising,
                 std::vector<double>& steps) {
    const int count = int(gauss.size());
    for (int i = 0; i < count; ++i) {
      const glm::dvec2 node = gauss[rising ? i : count - 1 - i];
      const double away = (end - begin) * node.x * node.x;
      lists.samples.push_back(sample_at(h, mu, rising ? begin + away : end - away));
      steps.push_back(2 * node.x * node.y * (end - begin));
    }
  }

  void add_weights(const MarchRay& ray, const std::vector<double>& steps, const glm::dvec3& whole) {
    const std::vector<atmosphere::SpectralBand>& bands = columns.medium().bands;
    const auto depth = [](const atmosphere::SpectralBand& band, const glm::dvec3& column) {
      return band.rayleigh_scattering_per_km * column.x +
             band.aerosol_extinction_per_km * column.y + band.ozone_absorption_per_km * column.z;
    };
    const size_t first = lists.rayleigh_weight.size();
    lists.rayleigh_weight.resize(first + steps.size() * bands.size());
    lists.aerosol_weight.resize(first + steps.size() * bands.size());
    for (size_t b = 0; b < bands.size(); ++b) {
      double lost = 0;
      for (size_t i = 0; i < steps.size(); ++i) {
        const MarchSample& sample = lists.samples[ray.first + i];
        const glm::dvec3 density = geometry.densities(sample.height_km);
        const double seen = std::exp(-depth(bands[b], sample.columns)) * steps[i];
        lost += seen * depth(bands[b], density);
        const size_t at = first + i * bands.size() + b;
        lists.rayleigh_weight[at] = seen * bands[b].rayleigh_scattering_per_km * density.x;
        lists.aerosol_weight[at] = seen * bands[b].aerosol_scattering_per_km * density.y;
      }
      const double whole_depth = depth(bands[b], whole);
      const double scale = lost > 0 ? -std::expm1(-whole_depth) / lost : 0;
      for (size_t i = 0; i < steps.size(); ++i) {
        lists.rayleigh_weight[first + i * bands.size() + b] *= scale;
        lists.aerosol_weight[first + i * bands.size() + b] *= scale;
      }
      lists.ground_transmittance.push_back(ray.hits_ground ? std::exp(-whole_depth) : 0);
    }
  }

  void add_ray(double h, double mu, bool to_ground) {
    MarchRay ray;
    ray.first = int(lists.samples.size());
    ray.hits_ground = to_ground;
    ray.length_km =
        to_ground ? geometry.distance_to_ground(h, mu) : geometry.distance_to_top(h, mu);
    const double r = geometry.radius_of(h), R = geometry.air.bottom_radius;
    const double lowest = std::clamp(-r * mu, 0.0, ray.length_km);
    ray.ground_sun_scale = r / R;
    ray.ground_nu_scale = ray.length_km / R;
    std::vector<double> cuts = march_cuts(columns, h, mu, ray.length_km);
    cuts.push_back(ray.length_km);
    std::vector<double> steps;
    double begin = 0;
    for (const double end : cuts) {
      if (end > begin) add_piece(h, mu, begin, end, begin >= lowest, steps);
      begin = end;
    }
    ray.count = int(lists.samples.size()) - ray.first;
    glm::dvec3 sum(0);
    double last = 0;
    for (int i = ray.first; i < ray.first + ray.count; ++i) {
      MarchSample& sample = lists.samples[i];
      sum += columns.paths().columns(h, mu, last, sample.distance_km, 16);
      sample.columns = sum;
      last = sample.distance_km;
    }
    sum += columns.paths().columns(h, mu, last, ray.length_km, 16);
    add_weights(ray, steps, sum);
    lists.rays.push_back(ray);
  }
};

}  // namespace

MarchLists march_lists(const Columns& columns, const Settings& settings, int samples) {
  Builder builder(columns, settings, samples);
  for (int i = 0; i < settings.heights; ++i) {
    const double h = height_node(columns.medium(), settings, i);
    builder.lists.rows.push_back(direction_rows(builder.geometry, settings, h));
    const DirectionRows rows = builder.lists.rows.back();
    for (size_t k = 0; k < rows.mu.size(); ++k) builder.add_ray(h, rows.mu[k], int(k) >= rows.up);
  }
  return builder.lists;
}

}  // namespace skylapse::sky::bruneton
