#include "sky/twilight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sky/hosek_wilkie/sky.h"

namespace skylapse::sky {
namespace {

double lux_at(double elevation_deg) { return clear_sky_illuminance(elevation_deg * deg).in(lux); }

// Values of USNO Circular 171's polynomials, printed with three to four digits. 0.6 %: their
// rounding, and half of the jump where two of the published pieces meet (largest at -0.8 and 5
// deg).
TEST(Twilight, MatchesThePublishedTable) {
  const struct {
    double elevation_deg, lux;
  } table[] = {{90, 128800},   {60, 103100},   {40, 67540},   {30, 46300},    {20, 27380},
               {15, 19230},    {10, 11120},    {5, 4538},     {3, 2689},      {1, 1268},
               {0, 759},       {-0.8, 462},    {-1, 405},     {-2, 189},      {-3, 79.1},
               {-4, 29.9},     {-5, 10.4},     {-6, 3.41},    {-7, 1.09},     {-8, 0.348},
               {-9, 0.116},    {-10, 0.0421},  {-11, 0.0171}, {-12, 0.00806}, {-13, 0.00456},
               {-14, 0.00292}, {-16, 0.00144}, {-18, 0.00064}};
  for (const auto& row : table)
    EXPECT_NEAR(lux_at(row.elevation_deg) / row.lux, 1, row.elevation_deg == -18 ? 0.008 : 0.006)
        << row.elevation_deg;
}

// Between its nodes the curve follows the published polynomials as the header states.
TEST(Twilight, FollowsThePublishedPolynomialsBetweenTheNodes) {
  const struct {
    double from, to, l0, l1, l2, l3;
  } pieces[] = {
      {20, 90, 3.74, 3.97, -4.07, 1.47},         {5, 20, 3.05, 13.28, -45.98, 64.33},
      {-0.8, 5, 2.88, 22.26, -207.64, 1034.30},  {-5, -0.8, 2.88, 21.81, -258.11, -858.36},
      {-12, -5, 2.70, 12.17, -431.69, -1899.83}, {-18, -12, 13.84, 262.72, 1447.42, 2797.93}};
  double worst = 0, worst_night = 0;
  for (const auto& p : pieces)
    for (double h = p.from; h <= p.to; h += 0.01) {
      const double x = h / 90;
      const double published = std::pow(10, p.l0 + x * (p.l1 + x * (p.l2 + x * p.l3)));
      const double error = std::abs(lux_at(h) / published - 1);
      (h < -17.5 ? worst_night : worst) = std::max(h < -17.5 ? worst_night : worst, error);
    }
  EXPECT_LT(worst, 0.006);
  EXPECT_LT(worst_night, 0.04);
}

TEST(Twilight, RisesMonotonouslyFromNightToNoon) {
  double previous = lux_at(-18);
  for (double h = -17.99; h <= 90; h += 0.01) {
    const double value = lux_at(h);
    EXPECT_GT(value, previous) << h;
    previous = value;
  }
}

// One degree of a sun's path is four minutes: a kink in log E would show as a flicker.
TEST(Twilight, HasNoJumpAndNoKink) {
  constexpr double kStep = 1e-4;
  auto slope = [](double h) {
    return (std::log10(lux_at(h + kStep)) - std::log10(lux_at(h))) / kStep;
  };
  for (double h = -19; h < 89.9; h += 0.05) {
    EXPECT_NEAR(lux_at(h + 1e-9) / lux_at(h), 1, 1e-8) << h;
    EXPECT_NEAR(slope(h), slope(h - kStep), 2e-3) << h;
  }
  for (const double joint : {-18.0, -12.0, -5.0, -0.8, 5.0, 20.0})
    EXPECT_NEAR(slope(joint), slope(joint - kStep), 2e-3) << joint;
}

TEST(Twilight, StaysAtTheNightValueBelowMinusEighteenDegrees) {
  EXPECT_EQ(lux_at(-18), lux_at(-18.001));
  EXPECT_EQ(lux_at(-18), lux_at(-90));
}

TEST(Twilight, LevelIsOneAtTheHorizonAndFallsSmoothlyToTheIlluminanceBelow) {
  const Angle horizon = -0.57 * deg;
  for (const double model_lux : {500.0, 759.0, 2400.0, 5000.0}) {
    const auto level = [&](double h) { return twilight_level(h * deg, horizon, model_lux * lux); };
    EXPECT_EQ(level(-0.57), 1.0);
    EXPECT_EQ(level(20), 1.0);
    EXPECT_NEAR(level(-0.57 - 1e-9), 1.0, 1e-8);
    for (const double h : {-6.57, -9.0, -12.0, -18.0, -40.0})
      EXPECT_NEAR(model_lux * level(h) / lux_at(h), 1, 1e-12) << h;
    double previous = 1.0;
    for (double h = -0.58; h > -18; h -= 0.01) {
      EXPECT_LT(level(h), previous) << h;
      EXPECT_GT(level(h), previous * 0.98) << "a step at " << h;
      previous = level(h);
    }
  }
}

// The table inside is the model's own diffuse light; between its nodes 3 % is far below what an
// exposure could show (0.04 stops).
TEST(Twilight, MeanLuminanceIsThatOfTheSkyModel) {
  for (double h = 0; h <= 90; h += 2.5) {
    const auto sky =
        hosek_wilkie::Sky::make(hosek_wilkie::Fit::spectral, hosek_wilkie::SolarFlux::reference,
                                2.5, grey_bands(0.2), h * deg);
    const double model = 683 * sky->diffuse_irradiance_xyz().y / std::numbers::pi;
    EXPECT_NEAR(mean_clear_sky_luminance(h * deg).in(cd_per_m2) / model, 1, 0.03) << h;
  }
}

TEST(Twilight, MeanLuminanceRisesWithTheSunWithoutAStep) {
  double previous = mean_clear_sky_luminance(-1 * deg).in(cd_per_m2);
  for (double h = -0.99; h <= 90; h += 0.01) {
    const double now = mean_clear_sky_luminance(h * deg).in(cd_per_m2);
    EXPECT_GE(now, previous * (1 - 1e-12)) << h;
    EXPECT_LT(now, previous * 1.01) << h;
    previous = now;
  }
}

TEST(ComputedSkyLuminance, FallsWithoutAStepFromTheZenithToTheNight) {
  double last = 1e9;
  for (double el = 90; el > -40; el -= 0.02) {
    const double now = mean_computed_sky_luminance(el * deg).in(cd_per_m2);
    EXPECT_LE(now, last) << el;
    // Dusk loses at most 2 stops a degree.
    EXPECT_GT(now, last < 1e8 ? last * 0.97 : 0) << el;
    last = now;
  }
  EXPECT_NEAR(last * std::numbers::pi, clear_sky_illuminance(-18 * deg).in(lux), 0.05 * 6.5e-4);
}

// The published twilight is that of a true sun, the computed one of the sun as it is seen; with an
// air of its own, within a factor of 1.6.
TEST(ComputedSkyLuminance, TwilightIsThePublishedOne) {
  for (double el = -2; el >= -12; el -= 0.5) {
    const double computed = mean_computed_sky_luminance(el * deg).in(cd_per_m2)*std::numbers::pi;
    const double published = clear_sky_illuminance(el * deg).in(lux);
    EXPECT_GT(computed / published, 1 / 1.6) << el;
    EXPECT_LT(computed / published, 1.6) << el;
  }
}

}  // namespace
}  // namespace skylapse::sky
