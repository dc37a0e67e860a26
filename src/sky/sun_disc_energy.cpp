// Reference energy of the disc. Coordinates on the sphere that suit both its limb and the horizon:
// psi turns about the horizontal axis a through the eye at right angles to the disc's centre c,
// lambda leads out of the vertical plane, and
//   d = sin(lambda) a + cos(lambda) (cos(psi) c + sin(psi) b),   b = upward at the centre,
//   elevation: sin = cos(lambda) sin(e + psi), so the horizon is psi = -e exactly,
//   dOmega = cos(lambda) dlambda dpsi.
// With s = sin(radius), sin(psi) = s sin(t) and sin(lambda) = s X sin(phi), where X is the limb at
// that psi, the limb variable is m = cos(t) cos(phi): the integrand is smooth up to the limb.
// Flattening multiplies psi by k and dOmega with it.
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

/// Upward at the centre of a disc: at right angles to it, in its vertical plane.
glm::dvec3 up_at(const Direction<Enu>& centre) {
  const glm::dvec3 c = centre.vec();
  const double horizontal = std::hypot(c.x, c.y);
  if (horizontal == 0) return {0, 1, 0};
  return {-c.x * c.z / horizontal, -c.y * c.z / horizontal, horizontal};
}

/// haversine_in_disc from the sine of lambda and from psi.
double flattened_haversine(double sin_lambda, double psi, double flattening) {
  const double cos_lambda = std::sqrt(std::max(0.0, 1 - sin_lambda * sin_lambda));
  const double half = std::sin(0.5 * psi / flattening);
  // 1 - cos(lambda) = sin^2 / (1 + cos): nothing cancels.
  return 0.5 * sin_lambda * sin_lambda / (1 + cos_lambda) + cos_lambda * half * half;
}

/// A piece of the disc, met twice: on either side of its vertical plane.
struct TwinPieces {
  glm::dvec3 flux{0};  // of both
  double sine = 0;     // of the elevation; 0 below the level
  double out_of_plane = 0, in_plane_forward = 0, in_plane_up = 0;  // in the axes of the centre
};

/// Of a disc that is cut along elevation 0, or not at all.
template <class Visit>
void visit_level_cut(const SunDisc& disc, bool cut, const Visit& visit) {
  static const GaussLegendre<32> outer;
  static const GaussLegendre<24> inner;
  const double s = sin(disc.radius);
  const double e = elevation(disc.centre).in(rad);
  const double k = disc.flattening, lowest = -e / k;  // psi / k at the horizon
  if (cut && lowest >= disc.radius.in(rad)) return;
  const bool whole = !cut || lowest <= -disc.radius.in(rad);
  const double t0 = whole ? -kPi / 2 : std::asin(std::clamp(std::sin(lowest) / s, -1.0, 1.0));
  const double half_t = 0.5 * (kPi / 2 - t0), middle_t = 0.5 * (kPi / 2 + t0);
  for (size_t i = 0; i < outer.nodes.size(); ++i) {
    const double t = middle_t + half_t * outer.nodes[i];
    const double sin_psi = s * std::sin(t), cos_psi = std::sqrt(1 - sin_psi * sin_psi);
    const double psi = k * std::asin(sin_psi);
    const double limb_x = std::cos(t) / cos_psi;
    const double dpsi = k * half_t * outer.weights[i] * s * std::cos(t) / cos_psi;
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
      visit(TwinPieces{domega * radiance, sine, sin_lambda, cos_lambda * std::cos(psi),
                       cos_lambda * std::sin(psi)});
    }
  }
}

struct Strip {
  double alpha, centre;  // elevations of the strip and of the disc's centre
  double flattening;

  [[nodiscard]] double haversine(double azimuth) const {
    if (flattening == 1) {
      const double x = std::sin(0.5 * (alpha - centre)), a = std::sin(0.5 * azimuth);
      return x * x + std::cos(alpha) * std::cos(centre) * a * a;
    }
    const double psi = std::atan2(std::sin(alpha), std::cos(alpha) * std::cos(azimuth)) - centre;
    return flattened_haversine(std::cos(alpha) * std::sin(azimuth), psi, flattening);
  }

  [[nodiscard]] double half_width(double radius) const {
    const double x = alpha - centre;
    const double edge = std::sin(0.5 * (radius + x)) * std::sin(0.5 * (radius - x)) /
                        (std::cos(alpha) * std::cos(centre));
    const double round = 2 * std::asin(std::sqrt(std::clamp(edge, 0.0, 1.0)));
    if (flattening == 1) return round;
    // Flattening takes from the strip: the round disc's half-width is the most it can be.
    const double limb = std::sin(0.5 * radius) * std::sin(0.5 * radius);
    double low = 0, high = round;
    for (int i = 0; i < 55; ++i) {
      const double middle = 0.5 * (low + high);
      (haversine(middle) < limb ? low : high) = middle;
    }
    return low;
  }
};

/// Of a disc that a horizon below the level cuts: that is a small circle of the sphere, so the disc
/// is taken in strips of equal elevation alpha = e + R sin(t), each of half-width D in azimuth,
///   sin^2(D / 2) = sin((R + x) / 2) sin((R - x) / 2) / (cos(alpha) cos(e)),   x = alpha - e
/// (haversines), within which the azimuth is D sin(phi). A flattened disc reaches k R up and down,
/// and its half-width is found by bisection.
template <class Visit>
void visit_dipped_cut(const SunDisc& disc, const Visit& visit) {
  static const GaussLegendre<32> outer;
  static const GaussLegendre<24> inner;
  const double r = disc.radius.in(rad), s = sin(disc.radius);
  const double e = elevation(disc.centre).in(rad), horizon = disc.horizon.in(rad);
  const double k = disc.flattening, reach = k * r;
  const double t0 = std::asin(std::clamp((horizon - e) / reach, -1.0, 1.0));
  const double half_t = 0.5 * (kPi / 2 - t0), middle_t = 0.5 * (kPi / 2 + t0);
  for (size_t i = 0; i < outer.nodes.size(); ++i) {
    const double t = middle_t + half_t * outer.nodes[i];
    const Strip strip{e + reach * std::sin(t), e, k};
    const double alpha = strip.alpha, half_width = strip.half_width(r);
    const double dalpha = half_t * outer.weights[i] * reach * std::cos(t);
    for (size_t j = 0; j < inner.nodes.size() / 2; ++j) {  // both halves are alike
      const double phi = 0.5 * kPi * inner.nodes[j];
      const double azimuth = half_width * std::sin(phi);
      const double hav = strip.haversine(azimuth);
      const double sine_gamma2 = 4 * hav * (1 - hav);
      const double limb = std::sqrt(std::max(0.0, 1 - sine_gamma2 / (s * s)));
      const double domega =
          2 * dalpha * std::cos(alpha) * 0.5 * kPi * inner.weights[j] * half_width * std::cos(phi);
      const glm::dvec3 radiance = disc.radiance(alpha * rad, limb);
      // Back into the axes of the centre, which stands at the elevation e.
      const double ahead = std::cos(alpha) * std::cos(azimuth);
      visit(TwinPieces{domega * radiance, std::max(0.0, std::sin(alpha)),
                       std::cos(alpha) * std::sin(azimuth),
                       ahead * std::cos(e) + std::sin(alpha) * std::sin(e),
                       std::sin(alpha) * std::cos(e) - ahead * std::sin(e)});
    }
  }
}

template <class Visit>
void visit_disc(const SunDisc& disc, const Visit& visit) {
  assert(disc.radius > Angle{} && disc.radius <= 10 * deg);
  assert(disc.flattening > 0 && disc.flattening <= 1);
  assert(disc.horizon <= Angle{} && disc.horizon > -90 * deg);
  if (disc.horizon == Angle{}) return visit_level_cut(disc, true, visit);
  const Angle over = elevation(disc.centre) - disc.horizon;
  const Angle reach = disc.flattening * disc.radius;
  if (over <= -reach) return;
  if (over >= reach) return visit_level_cut(disc, false, visit);
  visit_dipped_cut(disc, visit);
}

}  // namespace

DiscRadiance without_limb_darkening(const DiscRadiance& radiance) {
  // With m = u^2 the power u^(2 alpha + 3) is smooth enough for few nodes.
  static const GaussLegendre<12> rule;
  return [radiance](Angle view_elevation, double) {
    glm::dvec3 mean{0};
    for (size_t i = 0; i < rule.nodes.size(); ++i) {
      const double u = 0.5 * (1 + rule.nodes[i]), m = u * u;
      mean += 0.5 * rule.weights[i] * 4 * u * m * radiance(view_elevation, m);
    }
    return mean;
  };
}

double haversine_in_disc(const SunDisc& disc, const Direction<Enu>& direction) {
  const glm::dvec3 c = disc.centre.vec(), up = up_at(disc.centre), d = direction.vec();
  const double sin_lambda = std::clamp(glm::dot(d, glm::cross(c, up)), -1.0, 1.0);
  const double psi = std::atan2(glm::dot(d, up), glm::dot(d, c));
  return flattened_haversine(sin_lambda, psi, disc.flattening);
}

DiscEnergy disc_energy(const SunDisc& disc) {
  DiscEnergy energy;
  visit_disc(disc, [&](const TwinPieces& p) {
    energy.normal_irradiance += p.flux;
    energy.horizontal_irradiance += p.sine * p.flux;
  });
  return energy;
}

std::vector<image::PointLight> disc_points(const SunDisc& disc) {
  const glm::dvec3 c = disc.centre.vec(), up = up_at(disc.centre), side = glm::cross(c, up);
  std::vector<image::PointLight> points;
  visit_disc(disc, [&](const TwinPieces& p) {
    const glm::dvec3 in_plane = p.in_plane_forward * c + p.in_plane_up * up;
    for (const double sign : {-1.0, 1.0})
      points.push_back(
          {Direction<Enu>::from_vector(in_plane + sign * p.out_of_plane * side), 0.5 * p.flux});
  });
  return points;
}

}  // namespace skylapse::sky
