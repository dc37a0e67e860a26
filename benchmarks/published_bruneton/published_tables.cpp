#include "published_tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skylapse::published {
namespace {

double root(double x) { return std::sqrt(std::max(x, 0.0)); }

/// A share in [0, 1] as a texel of n whose centres include both ends, and back.
double texel_of(double share, int n) { return std::clamp(share, 0.0, 1.0) * (n - 1); }
double share_of(int texel, int n) { return double(texel) / (n - 1); }

struct Between {
  int low, high;
  float weight;
};
Between between(double x, int n) {
  const int low = std::clamp(int(x), 0, n - 1);
  return {low, std::min(low + 1, n - 1), float(std::clamp(x - low, 0.0, 1.0))};
}

Float4 mix(Float4 a, Float4 b, float w) { return a + (b - a) * w; }

}  // namespace

Mapping::Mapping(const sky::atmosphere::Medium& medium, const Sizes& sizes)
    : sizes(sizes),
      bottom(medium.bottom_radius_km),
      top(medium.bottom_radius_km + medium.top_height_km),
      horizon(std::sqrt(top * top - bottom * bottom)),
      least_mu_s(std::cos(120 * std::numbers::pi / 180)) {}

double Mapping::clamp_radius(double r) const { return std::clamp(r, bottom, top); }

double Mapping::to_top(double r, double mu) const {
  return std::max(0.0, -r * mu + root(r * r * (mu * mu - 1) + top * top));
}

double Mapping::to_ground(double r, double mu) const {
  return std::max(0.0, -r * mu - root(r * r * (mu * mu - 1) + bottom * bottom));
}

bool Mapping::hits_ground(double r, double mu) const {
  return mu < 0 && r * r * (mu * mu - 1) + bottom * bottom >= 0;
}

void Mapping::transmittance_texel(double r, double mu, double& x, double& y) const {
  const double rho = root(r * r - bottom * bottom);
  const double least = top - r, most = rho + horizon;
  x = texel_of((to_top(r, mu) - least) / (most - least), sizes.transmittance_mu);
  y = texel_of(rho / horizon, sizes.transmittance_r);
}

void Mapping::transmittance_point(int x, int y, double& r, double& mu) const {
  const double rho = horizon * share_of(y, sizes.transmittance_r);
  r = std::sqrt(rho * rho + bottom * bottom);
  const double least = top - r, most = rho + horizon;
  const double d = least + share_of(x, sizes.transmittance_mu) * (most - least);
  mu = d == 0 ? 1 : (horizon * horizon - rho * rho - d * d) / (2 * r * d);
  mu = std::clamp(mu, -1.0, 1.0);
}

void Mapping::irradiance_texel(double r, double mu_s, double& x, double& y) const {
  x = texel_of(mu_s * 0.5 + 0.5, sizes.irradiance_mu_s);
  y = texel_of((r - bottom) / (top - bottom), sizes.irradiance_r);
}

void Mapping::irradiance_point(int x, int y, double& r, double& mu_s) const {
  r = bottom + share_of(y, sizes.irradiance_r) * (top - bottom);
  mu_s = 2 * share_of(x, sizes.irradiance_mu_s) - 1;
}

/// Distance to the top from the ground towards the sun, folded so that low suns get the texels.
double Mapping::sun_coordinate(double mu_s) const {
  const double least = top - bottom, most = horizon;
  const double a = (to_top(bottom, mu_s) - least) / (most - least);
  const double limit = (to_top(bottom, least_mu_s) - least) / (most - least);
  return std::max(1 - a / limit, 0.0) / (1 + a);
}

void Mapping::scattering_texel(const Geometry& g, double texel[4]) const {
  const double rho = root(g.r * g.r - bottom * bottom);
  const double rmu = g.r * g.mu, discriminant = rmu * rmu - g.r * g.r + bottom * bottom;
  const int half = sizes.mu / 2;
  if (g.hits_ground) {
    const double d = -rmu - root(discriminant), least = g.r - bottom, most = rho;
    const double share = most == least ? 0 : (d - least) / (most - least);
    texel[2] = half - 1 - texel_of(share, half);
  } else {
    const double d = -rmu + root(discriminant + horizon * horizon);
    const double least = top - g.r, most = rho + horizon;
    texel[2] = half + texel_of((d - least) / (most - least), half);
  }
  texel[0] = texel_of((g.nu + 1) / 2, sizes.nu);
  texel[1] = texel_of(sun_coordinate(g.mu_s), sizes.mu_s);
  texel[3] = texel_of(rho / horizon, sizes.r);
}

Geometry Mapping::scattering_point(int nu, int mu_s, int mu, int r) const {
  Geometry g;
  const double rho = horizon * share_of(r, sizes.r);
  g.r = std::sqrt(rho * rho + bottom * bottom);
  const int half = sizes.mu / 2;
  g.hits_ground = mu < half;
  if (g.hits_ground) {
    const double least = g.r - bottom, most = rho;
    const double d = least + (most - least) * share_of(half - 1 - mu, half);
    g.mu = d == 0 ? -1 : -(rho * rho + d * d) / (2 * g.r * d);
  } else {
    const double least = top - g.r, most = rho + horizon;
    const double d = least + (most - least) * share_of(mu - half, half);
    g.mu = d == 0 ? 1 : (horizon * horizon - rho * rho - d * d) / (2 * g.r * d);
  }
  g.mu = std::clamp(g.mu, -1.0, 1.0);
  const double x = share_of(mu_s, sizes.mu_s);
  const double least = top - bottom, most = horizon;
  const double limit = (to_top(bottom, least_mu_s) - least) / (most - least);
  const double a = (limit - x * limit) / (1 + x * limit);
  const double d = least + std::min(a, limit) * (most - least);
  g.mu_s = d == 0 ? 1 : (horizon * horizon - d * d) / (2 * bottom * d);
  g.mu_s = std::clamp(g.mu_s, -1.0, 1.0);
  // Not every nu exists for these mu and mu_s.
  const double middle = g.mu * g.mu_s;
  const double width = std::sqrt((1 - g.mu * g.mu) * (1 - g.mu_s * g.mu_s));
  g.nu = std::clamp(2 * share_of(nu, sizes.nu) - 1, middle - width, middle + width);
  return g;
}

Float4 Table2::lookup(double x, double y) const {
  const Between u = between(x, width_), v = between(y, height());
  const Float4* low = &values_[size_t(v.low) * size_t(width_)];
  const Float4* high = &values_[size_t(v.high) * size_t(width_)];
  return mix(mix(low[u.low], low[u.high], u.weight), mix(high[u.low], high[u.high], u.weight),
             v.weight);
}

void Table2::add(const Table2& other) {
  for (size_t i = 0; i < values_.size(); ++i) values_[i] += other.values_[i];
}

Table4::Table4(const Sizes& sizes)
    : nu_count_(sizes.nu),
      mu_s_count_(sizes.mu_s),
      mu_count_(sizes.mu),
      r_count_(sizes.r),
      values_(size_t(sizes.texels())) {}

Float4 Table4::lookup(const double texel[4]) const {
  const Between n = between(texel[0], nu_count_), s = between(texel[1], mu_s_count_);
  const Between m = between(texel[2], mu_count_), r = between(texel[3], r_count_);
  const size_t step_n = size_t(mu_s_count_), step_m = step_n * size_t(nu_count_);
  const size_t step_r = step_m * size_t(mu_count_);
  const auto trilinear = [&](int nu) {
    const Float4* slice = values_.data() + size_t(nu) * step_n;
    const auto row = [&](int mu, int radius) {
      const Float4* at = slice + size_t(mu) * step_m + size_t(radius) * step_r;
      return mix(at[s.low], at[s.high], s.weight);
    };
    return mix(mix(row(m.low, r.low), row(m.high, r.low), m.weight),
               mix(row(m.low, r.high), row(m.high, r.high), m.weight), r.weight);
  };
  return mix(trilinear(n.low), trilinear(n.high), n.weight);
}

}  // namespace skylapse::published
