#pragma once
// The steps of precomputation in plain C++: first order, gather, march on.
#include <vector>

#include "sky/bruneton/columns.h"
#include "sky/bruneton/harmonics.h"
#include "sky/bruneton/march_lists.h"
#include "sky/bruneton/sun_rows.h"

namespace skylapse::sky::bruneton {

/// Incident light of one order at the points, and the ground's irradiance by it. Per group of four
/// bands: light[point height][direction row][sun node][azimuth], azimuth fastest.
struct IncidentLight {
  std::vector<std::vector<glm::dvec4>> light;
  std::vector<std::vector<glm::dvec4>> ground;  // [sun row]: horizontal, by the upper directions
};

/// The source of one order per unit scattering, per group:
/// source[height][zenith][sun row][azimuth].
using Source = std::vector<std::vector<glm::dvec4>>;

/// Everything that the orders share. `columns` must outlive it.
class ScatteringOrders {
 public:
  /// `count` groups of bands from `first_group` on; IncidentLight and Source number them from 0.
  ScatteringOrders(const Columns& columns, const Settings& settings, int first_group, int count);

  /// Light scattered once, and direct sunlight off the ground.
  [[nodiscard]] IncidentLight first_order();
  /// Incident light times the phase function, integrated over the sphere.
  [[nodiscard]] Source gather(const IncidentLight& incident) const;
  /// Light of the next order along the rays: what `source` scatters in, and the ground lit by
  /// `incident`.
  [[nodiscard]] IncidentLight march(const Source& source, const IncidentLight& incident) const;

  /// Fills the rows between the sun nodes, of a source and of ground light.
  void fill_rows(std::vector<glm::dvec4>& source, std::vector<glm::dvec4>& ground) const;

  [[nodiscard]] int groups() const { return int(data_.groups.size()); }

 private:
  void first_order_ray(size_t ray, IncidentLight& out);
  void march_ray(size_t ray, const Source& source, const IncidentLight& before,
                 IncidentLight& out) const;
  void gather_point(size_t height, size_t sun, const IncidentLight& incident, Source& out) const;
  void fill_sun_rows(size_t height, std::vector<glm::dvec4>& source) const;
  void fill_ground_rows(std::vector<glm::dvec4>& ground) const;
  void light_ground(IncidentLight& incident) const;
  [[nodiscard]] IncidentLight empty_light() const;
  [[nodiscard]] glm::dvec4 weight(const std::vector<double>& weights, size_t item, int group) const;
  [[nodiscard]] double sun_row(double mu_s) const;

  Settings settings_;
  int first_group_;
  PhysicsData data_;  // of these groups
  SunNodes suns_;
  HarmonicIndex index_;
  MarchLists first_lists_, lists_;
  std::vector<double> sun_mu_;                             // of the sun nodes
  std::vector<double> azimuth_cosine_;                     // of the directions
  std::vector<double> row_of_zenith_;                      // sun row over the zenith angle, fine
  std::vector<std::vector<double>> analysis_;              // [height]: [row][harmonic] with weights
  std::vector<std::vector<double>> synthesis_;             // [zenith]: [harmonic]
  std::vector<double> direction_cosines_, table_cosines_;  // [azimuth][m]
  /// [height][group][l]: Legendre moment of the mixture's phase function.
  std::vector<std::vector<std::vector<glm::dvec4>>> moments_;
};

}  // namespace skylapse::sky::bruneton
