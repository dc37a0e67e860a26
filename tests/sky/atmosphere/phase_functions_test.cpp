#include "sky/atmosphere/phase_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skylapse::sky::atmosphere {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kShapes[] = {-0.99, -0.5, 0.0, 0.3, 0.7, 0.8, 0.9, 0.95, 0.99};
constexpr int kDegree = 64;

/// Legendre polynomials P_0..P_degree at nu.
std::vector<double> legendre(int degree, double nu) {
  std::vector<double> p{1, nu};
  for (int l = 1; l < degree; ++l) p.push_back(((2 * l + 1) * nu * p[l] - l * p[l - 1]) / (l + 1));
  return p;
}

/// 2 pi times the integral of phase P_l for all l: midpoints in s, 1 - |nu| = s^3 on either half,
/// so that a peak of width (1 - |g|)^2 is met by thousands of points.
template <class Phase>
std::vector<double> moments_by_quadrature(const Phase& phase) {
  constexpr int kSteps = 40000;
  std::vector<double> sum(kDegree + 1, 0.0);
  for (int i = 0; i < kSteps; ++i) {
    const double s = (i + 0.5) / kSteps;
    const double weight = 2 * kPi * 3 * s * s / kSteps;
    for (const double side : {1.0, -1.0}) {
      const double nu = side * (1 - s * s * s);
      const std::vector<double> p = legendre(kDegree, nu);
      const double f = weight * phase(nu);
      for (int l = 0; l <= kDegree; ++l) sum[l] += f * p[l];
    }
  }
  return sum;
}

TEST(AerosolPhase, MomentsAreThoseOfQuadratureUpToDegree64) {
  for (const double g : kShapes) {
    const auto closed = aerosol_moments(g, kDegree);
    const auto summed = moments_by_quadrature([&](double nu) { return aerosol_phase(g, nu); });
    ASSERT_EQ(closed.size(), size_t{kDegree + 1});
    for (int l = 0; l <= kDegree; ++l)  // the quadrature's own error, at g = 0.99
      EXPECT_NEAR(closed[l], summed[l], 2e-6) << g << " " << l;
  }
}

TEST(AerosolPhase, IntegratesToOneForEveryShape) {
  for (const double g : kShapes) {
    EXPECT_NEAR(aerosol_moments(g, 0).at(0), 1, 1e-15) << g;
    EXPECT_NEAR(moments_by_quadrature([&](double nu) { return aerosol_phase(g, nu); })[0], 1, 2e-6)
        << g;
  }
}

TEST(AerosolPhase, MeanCosineIsThatOfCornetteAndShanks) {
  for (const double g : kShapes)
    EXPECT_NEAR(aerosol_moments(g, 1).at(1), 3 * g * (4 + g * g) / (5 * (2 + g * g)), 1e-15) << g;
  EXPECT_NEAR(aerosol_moments(0.8, 1)[1], 0.8436, 1e-4);
}

TEST(AerosolPhase, WithoutPreferenceIsRayleighs) {
  for (const double nu : {-1.0, -0.3, 0.0, 0.9, 1.0})
    EXPECT_DOUBLE_EQ(aerosol_phase(0, nu), rayleigh_phase(0, nu));
}

TEST(AerosolPhase, IsItsMirrorImageForTheOppositeShape) {
  for (const double g : kShapes)
    for (const double nu : {-1.0, -0.999999, -0.2, 0.5, 1.0})
      EXPECT_DOUBLE_EQ(aerosol_phase(g, nu), aerosol_phase(-g, -nu));
}

TEST(AerosolPhase, PeakIsSharpAndRightAtTheEdgeOfItsDomain) {
  // At nu = 1: 3 / (4 pi) (1 + g) / ((2 + g^2) (1 - g)^2).
  for (const double g : {0.99, 0.999999, 1 - 1e-9}) {
    const double expected = 3 / (4 * kPi) * (1 + g) / ((2 + g * g) * (1 - g) * (1 - g));
    EXPECT_NEAR(aerosol_phase(g, 1) / expected, 1, 1e-14) << g;
    EXPECT_GT(aerosol_phase(g, -1), 0) << g;
  }
}

TEST(RayleighPhase, MomentsAreThoseOfQuadrature) {
  for (const double rho : {0.0, 0.0283, 0.5, 1.0}) {
    const auto closed = rayleigh_moments(rho, kDegree);
    const auto summed = moments_by_quadrature([&](double nu) { return rayleigh_phase(rho, nu); });
    for (int l = 0; l <= kDegree; ++l) EXPECT_NEAR(closed[l], summed[l], 1e-8) << rho << " " << l;
  }
}

TEST(RayleighPhase, IsThePlainOneWithoutDepolarization) {
  for (const double nu : {-1.0, 0.0, 0.4})
    EXPECT_NEAR(rayleigh_phase(0, nu), 3 / (16 * kPi) * (1 + nu * nu), 1e-16);
  EXPECT_NEAR(rayleigh_phase(1, 0.3), 1 / (4 * kPi), 1e-16);  // fully depolarized: even
}

}  // namespace
}  // namespace skylapse::sky::atmosphere
