#include "sky/atmosphere/phase_functions.h"

#include <cmath>
#include <numbers>

namespace skylapse::sky::atmosphere {
namespace {

constexpr double kPi = std::numbers::pi;

/// Moments of nu f(nu) from those of f, one degree fewer: (2l+1) nu P_l = (l+1) P_{l+1} + l
/// P_{l-1}.
std::vector<double> times_cosine(const std::vector<double>& moments) {
  std::vector<double> product(moments.size() - 1);
  for (size_t i = 0; i < product.size(); ++i) {
    const auto l = static_cast<double>(i);
    const double below = i == 0 ? 0 : moments[i - 1];
    product[i] = ((l + 1) * moments[i + 1] + l * below) / (2 * l + 1);
  }
  return product;
}

}  // namespace

double rayleigh_phase(double rho, double nu) {
  return 3 / (8 * kPi * (2 + rho)) * ((1 + rho) + (1 - rho) * nu * nu);
}

double aerosol_phase(double g, double nu) {
  // 1 - g^2 and 1 + g^2 - 2 g nu without cancellation where the peak is.
  const double d =
      g >= 0 ? (1 - g) * (1 - g) + 2 * g * (1 - nu) : (1 + g) * (1 + g) - 2 * g * (1 + nu);
  return 3 / (8 * kPi) * (1 - g) * (1 + g) / (2 + g * g) * (1 + nu * nu) / (d * std::sqrt(d));
}

std::vector<double> rayleigh_moments(double rho, int degree) {
  std::vector<double> chi(static_cast<size_t>(degree) + 1, 0.0);
  chi[0] = 1;
  if (degree >= 2) chi[2] = (1 - rho) / (5 * (2 + rho));
  return chi;
}

std::vector<double> aerosol_moments(double g, int degree) {
  // Henyey-Greenstein's moments are g^l; Cornette-Shanks is that times 3 (1 + nu^2) / (2 (2 +
  // g^2)).
  const auto count = static_cast<size_t>(degree) + 1;
  std::vector<double> chi(count + 2);
  double power = 1;
  for (double& moment : chi) {
    moment = power;
    power *= g;
  }
  const std::vector<double> squared = times_cosine(times_cosine(chi));
  chi.resize(count);
  for (size_t l = 0; l < count; ++l) chi[l] = 3 / (2 * (2 + g * g)) * (chi[l] + squared[l]);
  return chi;
}

}  // namespace skylapse::sky::atmosphere
