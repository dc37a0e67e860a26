#include "sky/bruneton/harmonics.h"

#include <cmath>
#include <numbers>

#include "sky/bruneton/directions.h"
#include "sky/bruneton/physics.h"

namespace skylapse::sky::bruneton {

std::vector<double> legendre_factors(int degree, double mu) {
  const HarmonicIndex index{degree};
  std::vector<double> factors(index.count());
  const double sine = std::sqrt(std::max(1 - mu * mu, 0.0));
  // Orthonormal recurrences (Holmes and Featherstone 2002, Eqs. 11-13), no Condon-Shortley sign;
  // for m > 0 twice the norm, as cos(m phi) alone stands for both signs of m.
  double diagonal = std::sqrt(1 / (4 * std::numbers::pi));
  for (int m = 0; m <= degree; ++m) {
    if (m > 0) diagonal *= sine * std::sqrt((2 * m + 1) / (2.0 * m)) * (m == 1 ? std::sqrt(2) : 1);
    double before = 0, here = diagonal;
    factors[index.at(m, m)] = here;
    for (int l = m + 1; l <= degree; ++l) {
      const double l2 = double(l) * l, m2 = double(m) * m, k = l - 1;
      const double a = std::sqrt((4 * l2 - 1) / (l2 - m2));
      const double b = l == m + 1 ? 0 : std::sqrt((k * k - m2) / (4 * k * k - 1));
      const double next = a * (mu * here - b * before);
      before = here;
      here = next;
      factors[index.at(l, m)] = here;
    }
  }
  return factors;
}

std::vector<double> rayleigh_moments(double depolarization, int degree) {
  std::vector<double> moments(degree + 1, 0.0);
  const double gamma = depolarization / (2 - depolarization);
  moments[0] = 1;
  if (degree >= 2) moments[2] = (1 - gamma) / (10 * (1 + 2 * gamma));
  return moments;
}

std::vector<double> aerosol_moments(double g, int degree) {
  const auto greenstein = [g](int l) { return l < 0 ? 0.0 : std::pow(g, l); };
  // Moments of nu f from those of f: ((l + 1) f_{l+1} + l f_{l-1}) / (2 l + 1).
  const auto once = [&](int l) {
    return l < 0 ? 0.0 : ((l + 1) * greenstein(l + 1) + l * greenstein(l - 1)) / (2 * l + 1);
  };
  std::vector<double> moments(degree + 1);
  for (int l = 0; l <= degree; ++l) {
    const double twice = ((l + 1) * once(l + 1) + l * once(l - 1)) / (2 * l + 1);
    moments[l] = 1.5 / (2 + g * g) * (greenstein(l) + twice);
  }
  return moments;
}

std::vector<std::vector<std::vector<glm::dvec4>>> mixture_moments(const atmosphere::Medium& medium,
                                                                  const Settings& settings) {
  const std::vector<double> rayleigh =
      rayleigh_moments(medium.rayleigh_depolarization, settings.harmonics);
  const std::vector<double> aerosol = aerosol_moments(medium.aerosol_g, settings.harmonics);
  const std::vector<text::BandGroup> groups = band_groups(medium);
  std::vector<std::vector<std::vector<glm::dvec4>>> moments(settings.heights);
  for (int i = 0; i < settings.heights; ++i) {
    // Just below the node: profiles end at the top, and the air there is what rays end in.
    const double h = height_node(medium, settings, i) * (1 - 1e-9);
    for (const text::BandGroup& group : groups) {
      const glm::dvec4 air = group.rayleigh_scattering * medium.rayleigh.at(h);
      const glm::dvec4 particles = group.aerosol_scattering * medium.aerosol.at(h);
      const glm::dvec4 both = air + particles;
      std::vector<glm::dvec4> mixed;
      for (int l = 0; l <= settings.harmonics; ++l) {
        glm::dvec4 value(rayleigh[l]);
        for (int c = 0; c < 4; ++c)
          if (both[c] > 0) value[c] = (air[c] * rayleigh[l] + particles[c] * aerosol[l]) / both[c];
        mixed.push_back(value);
      }
      moments[i].push_back(std::move(mixed));
    }
  }
  return moments;
}

}  // namespace skylapse::sky::bruneton
