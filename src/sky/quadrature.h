#pragma once
// Gauss-Legendre quadrature.
#include <array>
#include <cmath>
#include <numbers>

namespace skylapse::sky {

struct QuadraturePoint {
  double x;       // in (0, 1)
  double weight;  // sum 1
};

/// Nodes and weights of order N on [0, 1]; exact for polynomials of degree 2N - 1.
/// Newton iteration on the Legendre polynomial, as in Press et al., Numerical Recipes, section 4.6.
template <int N>
std::array<QuadraturePoint, N> gauss_legendre() {
  std::array<QuadraturePoint, N> points{};
  for (int i = 0; i < N; ++i) {
    double z = std::cos(std::numbers::pi * (i + 0.75) / (N + 0.5));
    double slope = 0;
    for (int iteration = 0; iteration < 8; ++iteration) {
      double p = 1, previous = 0;
      for (int k = 0; k < N; ++k) {
        const double older = previous;
        previous = p;
        p = ((2 * k + 1) * z * previous - k * older) / (k + 1);
      }
      slope = N * (z * p - previous) / (z * z - 1);
      z -= p / slope;
    }
    points[i] = {(1 - z) / 2, 1 / ((1 - z * z) * slope * slope)};
  }
  return points;
}

}  // namespace skylapse::sky
