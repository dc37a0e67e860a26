#include "astro/refraction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "measured.h"

namespace skylapse::astro::test {
namespace {

const RefractionConditions kStandard{};
const RefractionConditions kDense{.pressure = 1085 * hPa, .temperature = -60 * degC};

double arcmin_at(double h, const RefractionConditions& air = kStandard) {
  return refraction(h * deg, air).in(arcmin);
}

TEST(Refraction, MatchesPublishedValues) {
  // Meeus 1998, ch. 16: 28.5' at true elevation 0 (0.1' model error), 5.3' at 10 deg, 1' at 45 deg.
  EXPECT_NEAR(arcmin_at(0), 28.98, 0.01);  // the formula itself: 1.02 / tan(10.3 / 5.11 deg)
  EXPECT_NEAR(arcmin_at(10), 5.4, 0.1);
  EXPECT_NEAR(arcmin_at(45), 1.01, 0.01);
}

TEST(Refraction, ScalesWithPressureAndAbsoluteTemperature) {
  const double standard = arcmin_at(5);
  EXPECT_NEAR(arcmin_at(5, {.pressure = 505 * hPa}), standard / 2, 1e-12);
  EXPECT_NEAR(arcmin_at(5, {.temperature = -131.5 * degC}), standard * 2, 1e-12);
  EXPECT_EQ(arcmin_at(5, {.pressure = 0 * hPa}), 0);
}

TEST(Refraction, OffMeansTheTrueDirectionItself) {
  const Direction<Enu> low = enu_direction(123 * deg, 0.3 * deg);
  EXPECT_EQ(lift_by_refraction(low, {.enabled = false}).vec(), low.vec());
  EXPECT_EQ(arcmin_at(0, {.enabled = false}), 0);
}

TEST(Refraction, IsFiniteNeverNegativeAndEndsAtBothEnds) {
  for (int i = -90000; i <= 90000; ++i) {
    const double r = arcmin_at(i / 1000.0);
    ASSERT_TRUE(std::isfinite(r) && r >= 0 && r < 45) << i;
  }
  EXPECT_EQ(arcmin_at(90), 0);
  EXPECT_EQ(arcmin_at(-5.11), arcmin_at(-5.11));  // the formula's pole
  EXPECT_GT(arcmin_at(-5.11), 0);
  EXPECT_EQ(arcmin_at(-6), 0);
  EXPECT_EQ(arcmin_at(-90), 0);
}

TEST(Refraction, ValueAndSlopeContinueAtTheJoints) {
  const double d = 1e-6;
  for (const double joint : {-1.0, -6.0}) {
    EXPECT_NEAR(arcmin_at(joint - d), arcmin_at(joint + d), 1e-4) << joint;
    const double below = (arcmin_at(joint - d) - arcmin_at(joint - 2 * d)) / d;
    const double above = (arcmin_at(joint + 2 * d) - arcmin_at(joint + d)) / d;
    EXPECT_NEAR(below, above, 1e-3) << joint;
  }
}

TEST(Refraction, ApparentElevationGrowsWithTrueElevationEvenInTheDensestAir) {
  double before = -90;
  for (int i = -8999; i <= 9000; ++i) {
    const double h = i / 100.0;
    const double apparent = h + arcmin_at(h, kDense) / 60;
    ASSERT_GT(apparent, before) << h;
    before = apparent;
  }
}

TEST(Refraction, LiftsByExactlyItsAngleInTheVerticalPlane) {
  Largest error;
  for (int az = 0; az < 360; az += 30)
    for (double h = -7; h <= 89.999; h += 0.37) {
      const Direction<Enu> truly = enu_direction(az * 1.0 * deg, h * deg);
      const Direction<Enu> expected =
          enu_direction(az * 1.0 * deg, h * deg + refraction(h * deg, kStandard));
      error.see(separation(lift_by_refraction(truly, kStandard), expected).in(arcsec),
                std::to_string(h));
    }
  expect_within(error, 1e-9, "lifted direction, arcsec");
}

TEST(Refraction, LeavesZenithAndNadirInPlace) {
  const auto zenith = Direction<Enu>::from_vector({0, 0, 1});
  const auto nadir = Direction<Enu>::from_vector({0, 0, -1});
  EXPECT_EQ(lift_by_refraction(zenith, kStandard).vec(), zenith.vec());
  EXPECT_EQ(lift_by_refraction(nadir, kStandard).vec(), nadir.vec());
}

}  // namespace
TEST(Flattening, OfASunOnTheHorizonIsAboutAFifth) {
  const RefractionConditions air{true, 1013 * hPa, 10 * degC};
  // Bennett 1982 and the almanacs: the setting sun is some 26' high and 32' wide; the formula of
  // the refraction, a few percent off its truth near the horizon, has 0.83 to 0.84.
  const Angle on_horizon = -34.2 * arcmin;
  EXPECT_NEAR(flattening(on_horizon, 16 * arcmin, air), 0.835, 0.01);
  EXPECT_GT(flattening(45 * deg, 16 * arcmin, air), 1 - 1e-3);
  EXPECT_LT(flattening(45 * deg, 16 * arcmin, air), 1);
}

TEST(Flattening, IsBetweenNothingAndOneEverywhere) {
  for (const double pressure : {0.0, 300.0, 1013.0, 2000.0})
    for (double el = -90; el <= 90; el += 0.05) {
      const double k = flattening(el * deg, 16 * arcmin, {true, pressure * hPa, -40 * degC});
      ASSERT_GT(k, 0.5) << el;
      ASSERT_LE(k, 1) << el;
    }
  EXPECT_EQ(flattening(1 * deg, 16 * arcmin, {false, 1013 * hPa, 10 * degC}), 1);
}

}  // namespace skylapse::astro::test
