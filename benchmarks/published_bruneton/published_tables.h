#pragma once
// The tables of the published scheme and their coordinates (Bruneton & Neyret 2008, section 4; the
// mappings are those of the authors' revision of 2017), at any size. Lengths in km. Up to four
// wavelengths, one texture channel each.
#include <atomic>
#include <cstdint>
#include <vector>

#include "sky/atmosphere/medium.h"

namespace skylapse::published {

using Float4 = float __attribute__((vector_size(16)));

/// Texture sizes; the defaults are the published ones.
struct Sizes {
  int transmittance_mu = 256, transmittance_r = 64;
  int irradiance_mu_s = 64, irradiance_r = 16;
  int r = 32, mu = 128, mu_s = 32, nu = 8;

  [[nodiscard]] int64_t texels() const { return int64_t{r} * mu * mu_s * nu; }
};

/// A point and two directions: r and the cosines mu (view), mu_s (sun), nu (view to sun).
struct Geometry {
  double r = 0, mu = 0, mu_s = 0, nu = 0;
  bool hits_ground = false;  // the view ray
};

/// Radii and the places of texels.
class Mapping {
 public:
  Mapping(const sky::atmosphere::Medium& medium, const Sizes& sizes);

  const Sizes sizes;
  const double bottom, top, horizon;  // horizon: distance to the top along the ground's horizon
  /// The sun is tabulated to this zenith angle: 120 deg (102 with half floats).
  const double least_mu_s;

  [[nodiscard]] double clamp_radius(double r) const;
  [[nodiscard]] double to_top(double r, double mu) const;
  [[nodiscard]] double to_ground(double r, double mu) const;
  [[nodiscard]] bool hits_ground(double r, double mu) const;

  /// Texture coordinates (texels, 0 .. n - 1) and back.
  void transmittance_texel(double r, double mu, double& x, double& y) const;
  void transmittance_point(int x, int y, double& r, double& mu) const;
  void irradiance_texel(double r, double mu_s, double& x, double& y) const;
  void irradiance_point(int x, int y, double& r, double& mu_s) const;
  /// [nu, mu_s, mu, r].
  void scattering_texel(const Geometry& g, double texel[4]) const;
  [[nodiscard]] Geometry scattering_point(int nu, int mu_s, int mu, int r) const;

 private:
  [[nodiscard]] double sun_coordinate(double mu_s) const;
};

/// A table with two coordinates, bilinear.
class Table2 {
 public:
  Table2(int width, int height) : width_(width), values_(size_t(width) * size_t(height)) {}
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return int(values_.size()) / width_; }
  Float4& at(int x, int y) { return values_[size_t(y) * size_t(width_) + size_t(x)]; }
  [[nodiscard]] Float4 lookup(double x, double y) const;
  void add(const Table2& other);

 private:
  int width_;
  std::vector<Float4> values_;
};

/// The table with four coordinates: two trilinear lookups, mixed by nu.
class Table4 {
 public:
  explicit Table4(const Sizes& sizes);
  Float4& at(int nu, int mu_s, int mu, int r) {
    return values_[((size_t(r) * size_t(mu_count_) + size_t(mu)) * size_t(nu_count_) + size_t(nu)) *
                       size_t(mu_s_count_) +
                   size_t(mu_s)];
  }
  [[nodiscard]] Float4 lookup(const double texel[4]) const;
  [[nodiscard]] size_t bytes() const { return values_.size() * sizeof(Float4); }
  std::vector<Float4>& values() { return values_; }

 private:
  int nu_count_, mu_s_count_, mu_count_, r_count_;
  std::vector<Float4> values_;
};

}  // namespace skylapse::published
