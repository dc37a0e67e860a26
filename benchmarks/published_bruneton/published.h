#pragma once
// The published precomputation, as its authors describe it and their revision of 2017 carries it
// out: transmittance, direct irradiance, single scattering apart for molecules and aerosol; then
// for each order the scattering density (16 x 32 directions of incident light at every texel), the
// ground's irradiance, and the integral along every view ray. Written anew for comparison, with
// the errata of the thesis that retold it (steps are the ray's length over N, sums add, theta runs
// over pi and phi over 2 pi). In its favour: float instead of half, aerosol kept for every
// wavelength instead of reconstructed from red.
#include <array>

#include "published_tables.h"

namespace skylapse::published {

/// Reads of the tables while precomputing. One lookup of the 4-D table is two trilinear fetches.
struct Counts {
  int64_t scattering = 0;    // 4-D lookups
  int64_t small_tables = 0;  // transmittance and irradiance
};

class Model {
 public:
  /// `orders` >= 1 of scattering. Computes everything, on all cores; up to four bands.
  Model(const sky::atmosphere::Medium& medium, const Sizes& sizes, int orders);

  /// Radiance scattered into the view ray, all orders, by table lookup alone (as published).
  [[nodiscard]] Float4 radiance(const Geometry& g) const;
  /// Scattering density of orders 2 and up, at a texel-free place: light scattered at a point into
  /// a direction per km.
  [[nodiscard]] Float4 density(const Geometry& g) const;

  [[nodiscard]] const Mapping& mapping() const { return map_; }
  [[nodiscard]] const Counts& counts() const { return counts_; }
  [[nodiscard]] size_t bytes() const;

 private:
  [[nodiscard]] Float4 transmittance_to_top(double r, double mu) const;
  [[nodiscard]] Float4 transmittance(const Geometry& g, double d) const;
  [[nodiscard]] Float4 transmittance_to_sun(double r, double mu_s) const;
  [[nodiscard]] Float4 irradiance(const Table2& table, double r, double mu_s) const;
  [[nodiscard]] Float4 light_of_order(int order, const Geometry& g) const;
  void make_transmittance();
  void make_direct_irradiance();
  void make_single_scattering();
  void make_density(int order);
  void make_indirect_irradiance(int order);
  void make_multiple_scattering();
  [[nodiscard]] Float4 density_at(int order, const Geometry& g) const;
  template <class Body>
  void for_texels(const Body& body);

  sky::atmosphere::Medium medium_;
  Mapping map_;
  std::array<Float4, 5> coefficients_{};  // Rayleigh, aerosol scattering and extinction, ozone, sun
  Float4 albedo_{};
  Table2 transmittance_, delta_irradiance_, irradiance_;
  Table4 single_rayleigh_, single_aerosol_;  // without phase functions
  Table4 delta_, density_;                   // of one order
  Table4 scattering_, density_sum_;          // orders 2 and up
  Counts counts_;
};

}  // namespace skylapse::published
