#pragma once
// Real spherical harmonics that are even in azimuth: a convolution with a phase function is a
// product of coefficients.
#include <glm/glm.hpp>
#include <vector>

#include "sky/atmosphere/medium.h"
#include "sky/bruneton/settings.h"

namespace skylapse::sky::bruneton {

/// Y_lm = normalised P_l^m(mu) cos(m phi), 0 <= m <= l <= degree; the integral of Y^2 over the
/// sphere is 1. Coefficients are ordered by m, then l.
struct HarmonicIndex {
  int degree;
  [[nodiscard]] int count() const { return (degree + 1) * (degree + 2) / 2; }
  /// Place of (m, m): those of (l, m) follow, l = m..degree.
  [[nodiscard]] int first(int m) const { return m * (degree + 1) - m * (m - 1) / 2; }
  [[nodiscard]] int at(int l, int m) const { return first(m) + l - m; }
};

/// The factors of Y_lm that depend on mu, all of them, by three-term recurrence. |mu| <= 1.
std::vector<double> legendre_factors(int degree, double mu);

/// Legendre moments of the phase functions, l = 0..degree: the integral of p(nu) P_l(nu) over the
/// sphere. chi_0 is 1.
std::vector<double> rayleigh_moments(double depolarization, int degree);
/// Cornette-Shanks in closed form: Henyey-Greenstein has g^l, (1 + nu^2) couples l - 2..l + 2.
std::vector<double> aerosol_moments(double g, int degree);

/// [height node][group of four bands][l]: moments of the phase function of the air as it is mixed
/// at the height nodes, (b_R rayleigh + b_M aerosol) / (b_R + b_M); of Rayleigh where nothing
/// scatters.
std::vector<std::vector<std::vector<glm::dvec4>>> mixture_moments(const atmosphere::Medium& medium,
                                                                  const Settings& settings);

}  // namespace skylapse::sky::bruneton
