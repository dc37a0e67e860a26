#include "sky/monte_carlo/shells.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sky/quadrature.h"

namespace skylapse::sky::monte_carlo {
namespace {
using atmosphere::Medium;
using atmosphere::reference_medium;

/// The columns of a ray by brute force: `steps` pieces of 16 Gauss nodes, blind to shells.
Columns brute_force(const Medium& medium, double height, double mu, double length, int steps) {
  const RayParabola ray(medium.bottom_radius_km, height, mu);
  Columns sum;
  for (int i = 0; i < steps; ++i)
    for (const QuadraturePoint& p : gauss_legendre<16>()) {
      const double h = ray.height(length * (i + p.x) / steps), w = p.weight * length / steps;
      sum += {w * medium.rayleigh.at(h), w * medium.aerosol.at(h), w * medium.ozone.at(h)};
    }
  return sum;
}

void expect_near_columns(const Columns& a, const Columns& b, double relative) {
  EXPECT_NEAR(a.rayleigh, b.rayleigh, relative * b.rayleigh + 1e-12);
  EXPECT_NEAR(a.aerosol, b.aerosol, relative * b.aerosol + 1e-12);
  EXPECT_NEAR(a.ozone, b.ozone, relative * b.ozone + 1e-12);
}

TEST(Shells, VerticalColumnsAreThoseInClosedForm) {
  const Medium medium = reference_medium();
  const Columns columns = Shells(medium).to_top(0, 1);
  EXPECT_NEAR(columns.rayleigh / medium.rayleigh.vertical_column_km(60), 1, 1e-8);
  EXPECT_NEAR(columns.aerosol / medium.aerosol.vertical_column_km(60), 1, 1e-8);
  EXPECT_NEAR(columns.ozone / medium.ozone.vertical_column_km(60), 1, 1e-12);
}

// 2e-6: the Gauss error stated beside the shells' cuts, for the 1.2 km aerosol seen level.
TEST(Shells, ColumnsAgreeWithBruteForceInAnyDirection) {
  const Medium medium = reference_medium();
  const Shells shells(medium);
  Trace trace;
  for (const double height : {0.0, 0.001, 1.0, 9.9999, 10.0, 39.0, 60.0})
    for (const double mu : {-1.0, -0.3, -0.05, -0.01, -1e-6, 0.0, 1e-6, 0.02, 0.3, 1.0}) {
      SCOPED_TRACE(testing::Message() << "height " << height << " mu " << mu);
      shells.follow(height, mu, trace);
      if (trace.length == 0) continue;
      expect_near_columns(trace.total, brute_force(medium, height, mu, trace.length, 400), 2e-6);
    }
}

TEST(Shells, ThinLayersAndGrowingDensitiesAreResolved) {
  Medium medium = reference_medium();
  medium.aerosol.terms = {
      {.top_km = 60, .amplitude = 1, .inverse_scale_height_per_km = 20},
      {.bottom_km = 18, .top_km = 18.01, .constant = 3},
      {.bottom_km = 2, .top_km = 5, .amplitude = 1e-3, .inverse_scale_height_per_km = -2}};
  const Shells shells(medium);
  EXPECT_NEAR(shells.to_top(0, 1).aerosol / medium.aerosol.vertical_column_km(60), 1, 1e-7);
  Trace trace;
  shells.follow(0, 0.01, trace);
  expect_near_columns(trace.total, brute_force(medium, 0, 0.01, trace.length, 40000), 1e-5);
}

TEST(Shells, RaysEndAtTheGroundBelowTheHorizonAndAtTheTopAboveIt) {
  const Shells shells(reference_medium());
  Trace trace;
  for (const double height : {0.0, 1e-5, 0.01, 1.0, 30.0, 60.0}) {
    const double horizon = shells.horizon_cosine(height);
    shells.follow(height, horizon - 1e-6, trace);
    EXPECT_TRUE(trace.hits_ground) << height;
    EXPECT_NEAR(RayParabola(6360, height, horizon - 1e-6).height(trace.length), 0, 1e-9);
    shells.follow(height, horizon + 1e-6, trace);
    EXPECT_FALSE(trace.hits_ground) << height;
    EXPECT_NEAR(RayParabola(6360, height, horizon + 1e-6).height(trace.length), 60, 1e-9);
  }
}

TEST(Shells, PiecesOfATraceJoinWithoutGaps) {
  const Shells shells(reference_medium());
  Trace trace;
  for (const double mu : {-0.9, -0.1, -0.02, 0.0, 0.5}) {
    shells.follow(11, mu, trace);
    ASSERT_FALSE(trace.pieces.empty());
    double at = 0;
    for (const Trace::Piece& piece : trace.pieces) {
      EXPECT_EQ(piece.begin, at);
      EXPECT_GT(piece.end, piece.begin);
      at = piece.end;
    }
    EXPECT_EQ(at, trace.length);
  }
}

}  // namespace
}  // namespace skylapse::sky::monte_carlo
