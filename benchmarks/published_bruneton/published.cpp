#include "published.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "sky/monte_carlo/phase.h"

namespace skylapse::published {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kTransmittanceSteps = 500, kRaySteps = 50;
constexpr int kThetas = 16, kPhis = 32;  // incident directions of the scattering density
constexpr int kGroundThetas = 16, kGroundPhis = 64;

Float4 exp_of(Float4 x) {
  return Float4{std::exp(x[0]), std::exp(x[1]), std::exp(x[2]), std::exp(x[3])};
}

double clamped(double cosine) { return std::clamp(cosine, -1.0, 1.0); }

double rayleigh_phase(const sky::atmosphere::Medium& medium, double nu) {
  return sky::monte_carlo::RayleighPhase(medium.rayleigh_depolarization).at(nu);
}

/// The sun's disc above the horizon of r: a smooth step.
double sun_visible(const Mapping& map, double alpha, double r, double mu_s) {
  const double sine = map.bottom / r;
  const double cosine = -std::sqrt(std::max(1 - sine * sine, 0.0));
  const double x = std::clamp((mu_s - cosine + sine * alpha) / (2 * sine * alpha), 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

}  // namespace

template <class Body>
void Model::for_texels(const Body& body) {
  const Sizes& n = map_.sizes;
  parallel_for_ranges(size_t(n.r) * size_t(n.mu), 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      for (int nu = 0; nu < n.nu; ++nu)
        for (int s = 0; s < n.mu_s; ++s) body(nu, s, int(i) % n.mu, int(i) / n.mu);
  });
}

Model::Model(const sky::atmosphere::Medium& medium, const Sizes& sizes, int orders)
    : medium_(medium),
      map_(medium, sizes),
      transmittance_(sizes.transmittance_mu, sizes.transmittance_r),
      delta_irradiance_(sizes.irradiance_mu_s, sizes.irradiance_r),
      irradiance_(sizes.irradiance_mu_s, sizes.irradiance_r),
      single_rayleigh_(sizes),
      single_aerosol_(sizes),
      delta_(sizes),
      density_(sizes),
      scattering_(sizes),
      density_sum_(sizes) {
  for (int c = 0; c < 4; ++c) {
    const auto& band = medium.bands[std::min(size_t(c), medium.bands.size() - 1)];
    coefficients_[0][c] = float(band.rayleigh_scattering_per_km);
    coefficients_[1][c] = float(band.aerosol_scattering_per_km);
    coefficients_[2][c] = float(band.aerosol_extinction_per_km);
    coefficients_[3][c] = float(band.ozone_absorption_per_km);
    coefficients_[4][c] = float(band.solar_irradiance);
    albedo_[c] = float(band.ground_albedo);
  }
  make_transmittance();
  make_direct_irradiance();
  make_single_scattering();
  for (int order = 2; order <= orders; ++order) {
    make_density(order);
    make_indirect_irradiance(order - 1);
    make_multiple_scattering();
  }
}

size_t Model::bytes() const {
  return single_rayleigh_.bytes() + single_aerosol_.bytes() + scattering_.bytes();
}

void Model::make_transmittance() {
  for (int y = 0; y < transmittance_.height(); ++y)
    for (int x = 0; x < transmittance_.width(); ++x) {
      double r = 0, mu = 0;
      map_.transmittance_point(x, y, r, mu);
      const double step = map_.to_top(r, mu) / kTransmittanceSteps;
      double columns[3] = {0, 0, 0};
      for (int i = 0; i <= kTransmittanceSteps; ++i) {
        const double d = i * step;
        const double h = std::sqrt(d * d + 2 * r * mu * d + r * r) - map_.bottom;
        const double weight = (i == 0 || i == kTransmittanceSteps ? 0.5 : 1.0) * step;
        columns[0] += weight * medium_.rayleigh.at(h);
        columns[1] += weight * medium_.aerosol.at(h);
        columns[2] += weight * medium_.ozone.at(h);
      }
      transmittance_.at(x, y) =
          exp_of(-(coefficients_[0] * float(columns[0]) + coefficients_[2] * float(columns[1]) +
                   coefficients_[3] * float(columns[2])));
    }
}

Float4 Model::transmittance_to_top(double r, double mu) const {
  double x = 0, y = 0;
  map_.transmittance_texel(r, mu, x, y);
  return transmittance_.lookup(x, y);
}

/// Over distance d along the view ray: the quotient of two lookups.
Float4 Model::transmittance(const Geometry& g, double d) const {
  const double there = map_.clamp_radius(std::sqrt(d * d + 2 * g.r * g.mu * d + g.r * g.r));
  const double mu = clamped((g.r * g.mu + d) / there);
  const Float4 a =
      g.hits_ground ? transmittance_to_top(there, -mu) : transmittance_to_top(g.r, g.mu);
  const Float4 b =
      g.hits_ground ? transmittance_to_top(g.r, -g.mu) : transmittance_to_top(there, mu);
  Float4 quotient;
  for (int c = 0; c < 4; ++c) quotient[c] = b[c] > 0 ? std::min(a[c] / b[c], 1.0f) : 0.0f;
  return quotient;
}

Float4 Model::transmittance_to_sun(double r, double mu_s) const {
  return transmittance_to_top(r, mu_s) *
         float(sun_visible(map_, medium_.sun_angular_radius_rad, r, mu_s));
}

Float4 Model::irradiance(const Table2& table, double r, double mu_s) const {
  double x = 0, y = 0;
  map_.irradiance_texel(r, mu_s, x, y);
  return table.lookup(x, y);
}

void Model::make_direct_irradiance() {
  const double alpha = medium_.sun_angular_radius_rad;
  for (int y = 0; y < irradiance_.height(); ++y)
    for (int x = 0; x < irradiance_.width(); ++x) {
      double r = 0, mu_s = 0;
      map_.irradiance_point(x, y, r, mu_s);
      const double cosine = mu_s < -alpha  ? 0
                            : mu_s > alpha ? mu_s
                                           : (mu_s + alpha) * (mu_s + alpha) / (4 * alpha);
      delta_irradiance_.at(x, y) = coefficients_[4] * transmittance_to_top(r, mu_s) * float(cosine);
    }
}

void Model::make_single_scattering() {
  for_texels([&](int nu, int s, int m, int radius) {
    const Geometry g = map_.scattering_point(nu, s, m, radius);
    const double step =
        (g.hits_ground ? map_.to_ground(g.r, g.mu) : map_.to_top(g.r, g.mu)) / kRaySteps;
    Float4 rayleigh{}, aerosol{};
    for (int i = 0; i <= kRaySteps; ++i) {
      const double d = i * step;
      const double there = map_.clamp_radius(std::sqrt(d * d + 2 * g.r * g.mu * d + g.r * g.r));
      const double mu_s = clamped((g.r * g.mu_s + d * g.nu) / there);
      const Float4 light = transmittance(g, d) * transmittance_to_sun(there, mu_s);
      const double weight = i == 0 || i == kRaySteps ? 0.5 * step : step;
      rayleigh += light * float(weight * medium_.rayleigh.at(there - map_.bottom));
      aerosol += light * float(weight * medium_.aerosol.at(there - map_.bottom));
    }
    single_rayleigh_.at(nu, s, m, radius) = rayleigh * coefficients_[4] * coefficients_[0];
    single_aerosol_.at(nu, s, m, radius) = aerosol * coefficients_[4] * coefficients_[1];
  });
  counts_.small_tables += map_.sizes.texels() * (kRaySteps + 1) * 3;
}

/// Radiance of one order along a ray.
Float4 Model::light_of_order(int order, const Geometry& g) const {
  double texel[4];
  map_.scattering_texel(g, texel);
  if (order > 1) return delta_.lookup(texel);
  const sky::monte_carlo::AerosolPhase aerosol(medium_.aerosol_g);
  return single_rayleigh_.lookup(texel) * float(rayleigh_phase(medium_, g.nu)) +
         single_aerosol_.lookup(texel) * float(aerosol.at(g.nu));
}

/// Light of `order` - 1 that is scattered at a point into the view ray.
Float4 Model::density_at(int order, const Geometry& g) const {
  // In the frame of the zenith: the view in the x-z plane.
  const double view_sine = std::sqrt(std::max(1 - g.mu * g.mu, 0.0));
  const double sun_x = view_sine == 0 ? 0 : (g.nu - g.mu * g.mu_s) / view_sine;
  const double sun_y = std::sqrt(std::max(1 - sun_x * sun_x - g.mu_s * g.mu_s, 0.0));
  const double h = g.r - map_.bottom;
  const Float4 molecules = coefficients_[0] * float(medium_.rayleigh.at(h));
  const Float4 particles = coefficients_[1] * float(medium_.aerosol.at(h));
  const sky::monte_carlo::AerosolPhase aerosol_phase(medium_.aerosol_g);
  constexpr double kStep = kPi / kThetas;
  Float4 sum{};
  for (int l = 0; l < kThetas; ++l) {
    const double cosine = std::cos((l + 0.5) * kStep), sine = std::sin((l + 0.5) * kStep);
    Geometry incident{g.r, cosine, g.mu_s, 0, map_.hits_ground(g.r, cosine)};
    double distance = 0;
    Float4 ground{};
    if (incident.hits_ground) {
      distance = map_.to_ground(g.r, cosine);
      ground = transmittance(incident, distance) * albedo_ * float(1 / kPi);
    }
    for (int m = 0; m < kPhis; ++m) {
      const double phi = (m + 0.5) * kStep;
      const double x = std::cos(phi) * sine, y = std::sin(phi) * sine;
      incident.nu = clamped(sun_x * x + sun_y * y + g.mu_s * cosine);
      Float4 light = light_of_order(order - 1, incident);
      if (incident.hits_ground) {
        const double sun_there = (g.r * g.mu_s + distance * incident.nu) / map_.bottom;
        light += ground * irradiance(delta_irradiance_, map_.bottom, clamped(sun_there));
      }
      const double nu = clamped(view_sine * x + g.mu * cosine);
      sum += light *
             (molecules * float(rayleigh_phase(medium_, nu)) +
              particles * float(aerosol_phase.at(nu))) *
             float(kStep * kStep * sine);
    }
  }
  return sum;
}

void Model::make_density(int order) {
  for_texels([&](int nu, int s, int m, int radius) {
    const Float4 value = density_at(order, map_.scattering_point(nu, s, m, radius));
    density_.at(nu, s, m, radius) = value;
    density_sum_.at(nu, s, m, radius) += value;
  });
  const int64_t lookups = map_.sizes.texels() * kThetas * kPhis;
  counts_.scattering += order == 2 ? 2 * lookups : lookups;
  counts_.small_tables += lookups / 2;
}

void Model::make_indirect_irradiance(int order) {
  const Sizes& n = map_.sizes;
  Table2 next(n.irradiance_mu_s, n.irradiance_r);
  parallel_for_ranges(size_t(n.irradiance_r), 1, [&](size_t begin, size_t end) {
    for (size_t row = begin; row < end; ++row)
      for (int column = 0; column < n.irradiance_mu_s; ++column) {
        double r = 0, mu_s = 0;
        map_.irradiance_point(column, int(row), r, mu_s);
        const double sun_x = std::sqrt(std::max(1 - mu_s * mu_s, 0.0));
        constexpr double kStep = kPi / (2 * kGroundThetas);
        Float4 sum{};
        for (int j = 0; j < kGroundThetas; ++j)
          for (int i = 0; i < kGroundPhis; ++i) {
            const double theta = (j + 0.5) * kStep, phi = (i + 0.5) * 2 * kPi / kGroundPhis;
            const double nu =
                clamped(sun_x * std::cos(phi) * std::sin(theta) + mu_s * std::cos(theta));
            const Float4 light = light_of_order(order, {r, std::cos(theta), mu_s, nu, false});
            sum += light * float(std::cos(theta) * std::sin(theta) * kStep * 2 * kPi / kGroundPhis);
          }
        next.at(column, int(row)) = sum;
      }
  });
  delta_irradiance_ = next;
  irradiance_.add(next);
  const int64_t lookups = int64_t{n.irradiance_mu_s} * n.irradiance_r * kGroundThetas * kGroundPhis;
  counts_.scattering += order == 1 ? 2 * lookups : lookups;
}

void Model::make_multiple_scattering() {
  for_texels([&](int nu, int s, int m, int radius) {
    const Geometry g = map_.scattering_point(nu, s, m, radius);
    const double step =
        (g.hits_ground ? map_.to_ground(g.r, g.mu) : map_.to_top(g.r, g.mu)) / kRaySteps;
    Float4 sum{};
    for (int i = 0; i <= kRaySteps; ++i) {
      const double d = i * step;
      Geometry there = g;
      there.r = map_.clamp_radius(std::sqrt(d * d + 2 * g.r * g.mu * d + g.r * g.r));
      there.mu = clamped((g.r * g.mu + d) / there.r);
      there.mu_s = clamped((g.r * g.mu_s + d * g.nu) / there.r);
      double texel[4];
      map_.scattering_texel(there, texel);
      sum += density_.lookup(texel) * transmittance(g, d) *
             float(i == 0 || i == kRaySteps ? 0.5 * step : step);
    }
    delta_.at(nu, s, m, radius) = sum;
    scattering_.at(nu, s, m, radius) += sum * float(1 / rayleigh_phase(medium_, g.nu));
  });
  counts_.scattering += map_.sizes.texels() * (kRaySteps + 1);
  counts_.small_tables += map_.sizes.texels() * (kRaySteps + 1) * 2;
}

Float4 Model::radiance(const Geometry& g) const {
  double texel[4];
  map_.scattering_texel(g, texel);
  const sky::monte_carlo::AerosolPhase aerosol(medium_.aerosol_g);
  return (scattering_.lookup(texel) + single_rayleigh_.lookup(texel)) *
             float(rayleigh_phase(medium_, g.nu)) +
         single_aerosol_.lookup(texel) * float(aerosol.at(g.nu));
}

Float4 Model::density(const Geometry& g) const {
  double texel[4];
  map_.scattering_texel(g, texel);
  return density_sum_.lookup(texel);
}

}  // namespace skylapse::published
