#include "sky/monte_carlo/phase.h"

#include <gtest/gtest.h>

#include "sky/quadrature.h"

namespace skylapse::sky::monte_carlo {
namespace {

/// 2 pi times the integral of f over nu in [-1, 1]; 64 nodes in each of `pieces` that shrink
/// towards both ends, where strongly asymmetric phase functions peak.
template <class F>
double over_sphere(const F& f) {
  const auto nodes = gauss_legendre<64>();
  double sum = 0;
  for (double sign : {-1.0, 1.0})
    for (double far = 1, near = 0.1; far > 1e-9; far = near, near /= 10) {
      if (near < 1e-8) near = 0;
      for (const QuadraturePoint& p : nodes) {
        const double distance = near + (far - near) * p.x;
        sum += p.weight * (far - near) * f(sign * (1 - distance));
      }
    }
  return 2 * std::numbers::pi * sum;
}

template <class Phase>
double mean_cosine_of_samples(const Phase& phase, int n, double& error) {
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    PathRandom random(3, uint64_t(i));
    const double nu = phase.sample(random);
    EXPECT_LE(std::abs(nu), 1);
    sum += nu, squares += nu * nu;
  }
  const double mean = sum / n;
  error = std::sqrt((squares / n - mean * mean) / n);
  return mean;
}

class AerosolPhaseOf : public ::testing::TestWithParam<double> {};

TEST_P(AerosolPhaseOf, IntegratesToOne) {
  const AerosolPhase phase(GetParam());
  EXPECT_NEAR(over_sphere([&](double nu) { return phase.at(nu); }), 1, 1e-9);
}

TEST_P(AerosolPhaseOf, SamplesHaveItsMeanCosine) {
  // Cornette & Shanks 1992: mean cosine 3 g (4 + g^2) / (5 (2 + g^2)).
  const double g = GetParam();
  double error = 0;
  const double mean = mean_cosine_of_samples(AerosolPhase(g), 40000, error);
  EXPECT_NEAR(mean, 3 * g * (4 + g * g) / (5 * (2 + g * g)), 4 * error);
}

INSTANTIATE_TEST_SUITE_P(AnyShape, AerosolPhaseOf,
                         ::testing::Values(-0.5, 0.0, 1e-4, 0.3, 0.8, 0.95, 0.99));

class RayleighPhaseOf : public ::testing::TestWithParam<double> {};

TEST_P(RayleighPhaseOf, IntegratesToOneAndIsSampledAsItIs) {
  const RayleighPhase phase(GetParam());
  EXPECT_NEAR(over_sphere([&](double nu) { return phase.at(nu); }), 1, 1e-12);
  const double second_moment = over_sphere([&](double nu) { return nu * nu * phase.at(nu); });
  double sum = 0, squares = 0;
  constexpr int n = 40000;
  for (int i = 0; i < n; ++i) {
    PathRandom random(4, uint64_t(i));
    const double nu = phase.sample(random), v = nu * nu;
    sum += v, squares += v * v;
  }
  const double mean = sum / n;
  EXPECT_NEAR(mean, second_moment, 4 * std::sqrt((squares / n - mean * mean) / n));
}

INSTANTIATE_TEST_SUITE_P(AnyDepolarisation, RayleighPhaseOf, ::testing::Values(0.0, 0.0279, 0.2));

TEST(RayleighPhase, WithoutDepolarisationIsThePlainOne) {
  EXPECT_NEAR(RayleighPhase(0).at(1), 3 / (8 * std::numbers::pi), 1e-15);
  EXPECT_NEAR(RayleighPhase(0).at(0), 3 / (16 * std::numbers::pi), 1e-15);
}

}  // namespace
}  // namespace skylapse::sky::monte_carlo
