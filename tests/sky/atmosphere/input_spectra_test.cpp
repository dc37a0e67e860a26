#include "sky/atmosphere/input_spectra.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skylapse::sky::atmosphere {
namespace {

TEST(InputSpectra, RayleighDepthIsThatOfBodhaine) {
  const Spectrum depth = rayleigh_optical_depth_spectrum();
  EXPECT_NEAR(depth.at(400.0 * nm), 0.3603, 5e-5);
  EXPECT_NEAR(depth.at(550.0 * nm), 0.0971, 5e-5);
  EXPECT_NEAR(depth.at(680.0 * nm), 0.0410, 5e-5);
  // Between nodes it goes on as a power law, not along the chord, which is 0.04 % above it.
  const double power = std::log(depth.at(405.0 * nm) / depth.at(400.0 * nm)) / std::log(405. / 400);
  EXPECT_NEAR(depth.at(402.0 * nm), depth.at(400.0 * nm) * std::pow(402. / 400, power), 1e-7);
}

TEST(InputSpectra, OzoneAbsorbsMostNear602Nm) {
  const Spectrum depth = ozone_optical_depth_spectrum();
  EXPECT_NEAR(300 * depth.at(602.0 * nm), 0.0416, 5e-5);
  for (double x = 430; x < 829; x += 1) EXPECT_LE(depth.at(x * nm), depth.at(602.0 * nm) * 1.001);
}

TEST(InputSpectra, OzoneBetweenItsTwoSourcesFallsWithoutAStep) {
  const Spectrum depth = ozone_optical_depth_spectrum();
  const double whole = std::log(depth.at(361.0 * nm) / depth.at(355.0 * nm));
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(std::log(depth.at((356.0 + i) * nm) / depth.at((355.0 + i) * nm)), whole / 6, 1e-9);
}

TEST(InputSpectra, DepolarizationIsKingsFactorAt550Nm) {
  const double rho = rayleigh_depolarization();
  EXPECT_NEAR((6 + 3 * rho) / (6 - 7 * rho), 1.0488, 5e-5);  // Bodhaine et al. 1999, Eq. (23)
}

TEST(InputSpectra, GroundsByName) {
  EXPECT_NEAR(ground_albedo_spectrum("grass")->at(360.0 * nm), 0.0180, 1e-12);
  EXPECT_EQ(ground_albedo_spectrum("sand")->at(700.0 * nm), 0.40);
  EXPECT_FALSE(ground_albedo_spectrum("lava").has_value());
}

}  // namespace
}  // namespace skylapse::sky::atmosphere
