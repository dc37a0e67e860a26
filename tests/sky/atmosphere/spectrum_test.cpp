#include "sky/atmosphere/spectrum.h"

#include <gtest/gtest.h>

namespace skylapse::sky::atmosphere {
namespace {

const Spectrum kRamp{{400, 500, 700}, {1, 3, 2}};

TEST(Spectrum, IsLinearBetweenNodesAndConstantOutside) {
  EXPECT_EQ(kRamp.at(400.0 * nm), 1);
  EXPECT_EQ(kRamp.at(450.0 * nm), 2);
  EXPECT_EQ(kRamp.at(600.0 * nm), 2.5);
  EXPECT_EQ(kRamp.at(300.0 * nm), 1);
  EXPECT_EQ(kRamp.at(900.0 * nm), 2);
}

TEST(Spectrum, MeanIsExactForStraightLines) {
  EXPECT_NEAR(kRamp.mean(400.0 * nm, 500.0 * nm), 2, 1e-15);
  // 1..3 over 100 nm, 3..2 over 200 nm, 2 over 100 nm.
  EXPECT_NEAR(kRamp.mean(400.0 * nm, 800.0 * nm), (200 + 500 + 200) / 400.0, 1e-14);
  EXPECT_NEAR(kRamp.mean(800.0 * nm, 400.0 * nm), kRamp.mean(400.0 * nm, 800.0 * nm), 0);
  EXPECT_EQ(kRamp.mean(450.0 * nm, 450.0 * nm), 2);
  EXPECT_NEAR(kRamp.mean(100.0 * nm, 300.0 * nm), 1, 1e-15);
}

TEST(Spectrum, MeansOfPartsAddUp) {
  const double whole = kRamp.mean(360.0 * nm, 830.0 * nm) * 470;
  double parts = 0;
  for (int i = 0; i < 47; ++i)
    parts += 10 * kRamp.mean((360.0 + 10 * i) * nm, (370.0 + 10 * i) * nm);
  EXPECT_NEAR(whole, parts, 1e-10);
}

TEST(Spectrum, OneNodeIsConstantAndNoneIsZero) {
  EXPECT_EQ(constant_spectrum(0.3).at(123.0 * nm), 0.3);
  EXPECT_EQ(constant_spectrum(0.3).mean(360.0 * nm, 830.0 * nm), 0.3);
  EXPECT_EQ(Spectrum{}.at(550.0 * nm), 0);
  EXPECT_EQ(Spectrum{}.mean(360.0 * nm, 830.0 * nm), 0);
}

}  // namespace
}  // namespace skylapse::sky::atmosphere
