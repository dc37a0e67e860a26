// Reference energy of the disc. Coordinates on the sphere that suit both its limb and the horizon:
// psi turns about the horizontal axis a through the eye at right angles to the disc's centre c,
// lambda leads out of the vertical plane, and
//   d = sin(lambda) a + cos(lambda) (cos(psi) c + sin(psi) b),   b = upward at the centre,
//   elevation: sin = cos(lambda) sin(e + psi), so the horizon is psi = -e exactly,
//   dOmega = cos(lambda) dlambda dpsi.
// With s = sin(radius), sin(psi) = s sin(t) and sin(lambda) = s X sin(phi), where X is the limb at
// that psi, the limb variable is m = cos(t) cos(phi): the integrand is smooth up to the limb.
#include <algorithm>
#include <array>
#include <numbers>

#include "sky/sun_disc.h"

namespace skylapse::sky {
namespace {

constexpr double kPi = std::numbers::pi;

template <int N>
struct GaussLegendre {
  std::array<double, N> nodes{}, weights{};  // on [-1, 1]

  /// Roots of the Legendre polynomial by Newton's method from Tricomi's estimate.
  GaussLegendre() {
    for (int i = 0; i < N; ++i) {
      double x = std::cos(kPi * (i + 0.75) / (N + 0.5)), slope = 1;
      for (int step = 0; step < 8; ++step) {
        double p = 1, previous = 0;
        for (int k = 0; k < N; ++k) {
          const double next = ((2 * k + 1) * x * p - k * previous) / (k + 1);
          previous = p;
          p = next;
        }
        slope = N * (x * p - previous) / (x * x - 1);
        x -= p / slope;
      }
      nodes[i] = x;
      weights[i] = 2 / ((1 - x * x) * slope * slope);
    }
  }
};

/// Of a disc that is cut along elevation 0, or not at all.
DiscEnergy energy_of_level_cut(const SunDisc& disc, bool cut) {
  static const GaussLegendre<32> outer;
  static const GaussLegendre<24> inner;
  const double s = sin(disc.radius);
  const double e = elevation(disc.centre).in(rad);
  const double sine_lowest = -std::sin(e) / s;  // sin(t) at the horizon
  DiscEnergy energy;
  if (cut && sine_lowest >= 1) return energy;
  const double t0 = !cut || sine_lowest <= -1 ? -kPi / 2 : std::asin(sine_lowest);
  const double half_t = 0.5 * (kPi / 2 - t0), middle_t = 0.5 * (kPi / 2 + t0);
  for (size_t i = 0; i < outer.nodes.size(); ++i) {
    const double t = middle_t + half_t * outer.nodes[i];
    const double sin_psi = s * std::sin(t), cos_psi = std::sqrt(1 - sin_psi * sin_psi);
    const double psi = std::asin(sin_psi);
    const double limb_x = std::cos(t) / cos_psi;
    const double dpsi = half_t * outer.weights[i] * s * std::cos(t) / cos_psi;
    for (size_t j = 0; j < inner.nodes.size() / 2; ++j) {  // both halves are alike
      const double phi = 0.5 * kPi * inner.nodes[j];
      const double sin_lambda = s * limb_x * std::sin(phi);
      const double cos_lambda = std::sqrt(1 - sin_lambda * sin_lambda);
      // cos(lambda) dlambda = d sin(lambda)
      const double domega = 2 * dpsi * 0.5 * kPi * inner.weights[j] * s * limb_x * std::cos(phi);
      const double signed_sine = cos_lambda * std::sin(e + psi);
      const double sine = std::max(0.0, signed_sine);
      const double cosine = std::hypot(sin_lambda, cos_lambda * std::cos(e + psi));
      const glm::dvec3 radiance =
          disc.radiance(atan2_angle(cut ? sine : signed_sine, cosine), std::cos(t) * std::cos(phi));
      energy.normal_irradiance += domega * radiance;
      energy.horizontal_irradiance += domega * sine * radiance;
    }
  }
  return energy;
}

/// Of a disc that a horizon below the level cuts: that is a small circle of the sphere, so the disc
/// is taken in strips of equal elevation alpha = e + R sin(t), each of half-width D in azimuth,
///   sin^2(D / 2) = sin((R + x) / 2) sin((R - x) / 2) / (cos(alpha) cos(e)),   x = alpha - e
/// (haversines), within which the azimuth is D sin(phi).
DiscEnergy energy_of_dipped_cut(const SunDisc& disc) {
  static const GaussLegendre<32> outer;
  static const GaussLegendre<24> inner;
  const double r = disc.radius.in(rad), s = sin(disc.radius);
  const double e = elevation(disc.centre).in(rad), horizon = disc.horizon.in(rad);
  const double t0 = std::asin(std::clamp((horizon - e) / r, -1.0, 1.0));
  const double half_t = 0.5 * (kPi / 2 - t0), middle_t = 0.5 * (kPi / 2 + t0);
  DiscEnergy energy;
  for (size_t i = 0; i < outer.nodes.size(); ++i) {
    const double t = middle_t + half_t * outer.nodes[i];
    const double x = r * std::sin(t), alpha = e + x;
    const double cosines = std::cos(alpha) * std::cos(e);
    const double edge = std::sin(0.5 * (r + x)) * std::sin(0.5 * (r - x)) / cosines;
    const double half_width = 2 * std::asin(std::sqrt(std::clamp(edge, 0.0, 1.0)));
    const double dalpha = half_t * outer.weights[i] * r * std::cos(t);
    for (size_t j = 0; j < inner.nodes.size() / 2; ++j) {  // both halves are alike
      const double phi = 0.5 * kPi * inner.nodes[j];
      const double azimuth = half_width * std::sin(phi);
      const double hav = std::sin(0.5 * x) * std::sin(0.5 * x) +
                         cosines * std::sin(0.5 * azimuth) * std::sin(0.5 * azimuth);
      const double sine_gamma2 = 4 * hav * (1 - hav);
      const double limb = std::sqrt(std::max(0.0, 1 - sine_gamma2 / (s * s)));
      const double domega =
          2 * dalpha * std::cos(alpha) * 0.5 * kPi * inner.weights[j] * half_width * std::cos(phi);
      const glm::dvec3 radiance = disc.radiance(alpha * rad, limb);
      energy.normal_irradiance += domega * radiance;
      energy.horizontal_irradiance += domega * std::max(0.0, std::sin(alpha)) * radiance;
    }
  }
  return energy;
}

}  // namespace

DiscEnergy disc_energy(const SunDisc& disc) {
  assert(disc.radius > Angle{} && disc.radius <= 10 * deg);
  assert(disc.horizon <= Angle{} && disc.horizon > -90 * deg);
  if (disc.horizon == Angle{}) return energy_of_level_cut(disc, true);
  const Angle over = elevation(disc.centre) - disc.horizon;
  if (over <= -disc.radius) return {};
  if (over >= disc.radius) return energy_of_level_cut(disc, false);
  return energy_of_dipped_cut(disc);
}

}  // namespace skylapse::sky
