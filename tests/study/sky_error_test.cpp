#include "study/sky_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace skylapse::study {
namespace {

/// The upper hemisphere in cells of 5 x 5 deg.
std::vector<SkyDirection> hemisphere() {
  std::vector<SkyDirection> directions;
  for (double el = 2.5; el < 90; el += 5)
    for (double az = 2.5; az < 360; az += 5) {
      const double cell = (sin((el + 2.5) * deg) - sin((el - 2.5) * deg)) * (5 * deg).in(rad);
      directions.push_back({enu_direction(az * deg, el * deg), cell * sr});
    }
  return directions;
}

const SkyGeometry kSunAt30{enu_direction(90 * deg, 30 * deg), {}};

TEST(SkyError, CombinesBrightnessAndColourInOneNumber) {
  EXPECT_NEAR(relative_error({1.1, 1.1, 1.1}, {1, 1, 1}), 0.1, 1e-15);
  EXPECT_NEAR(relative_error({1, 0, 0}, {0, 1, 0}), std::sqrt(2.0), 1e-15);
  EXPECT_EQ(relative_error({1, 2, 3}, {1, 2, 3}), 0);
}

TEST(SkyError, IsInfiniteWhereAPictureIsNotANumberOrLightComesFromNowhere) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isinf(relative_error({nan, 0, 0}, {1, 1, 1})));
  EXPECT_TRUE(std::isinf(relative_error({1, 1, 1}, {0, 0, 0})));
  EXPECT_EQ(relative_error({0, 0, 0}, {0, 0, 0}), 0);
}

TEST(SkyError, UniformOffsetIsTheRmsTheQuantileAndTheMaximumEverywhere) {
  const auto sky = hemisphere();
  const std::vector<TrueRadiance> truth(sky.size(), {{1, 2, 3}, {0, 0, 0}});
  const std::vector<glm::dvec3> picture(sky.size(), 1.02 * glm::dvec3(1, 2, 3));
  const SkyErrors errors = sky_errors(sky, picture, truth, kSunAt30);
  for (int region = 0; region < kSkyRegions; ++region) {
    SCOPED_TRACE(kSkyRegionNames[region]);
    const ErrorMeasure& m = errors.by_region[region];
    EXPECT_GT(m.directions, 0);
    for (const double value : {m.rms, m.raw_rms, m.p95, m.max}) EXPECT_NEAR(value, 0.02, 1e-12);
  }
  EXPECT_NEAR(errors.sky().solid_angle, 2 * std::numbers::pi, 1e-12);
  EXPECT_LT(errors.chromaticity.max, 1e-12);
}

TEST(SkyError, RegionsHoldTheirSolidAngles) {
  const auto sky = hemisphere();
  const std::vector<TrueRadiance> truth(sky.size(), {{1, 1, 1}, {0, 0, 0}});
  const std::vector<glm::dvec3> picture(sky.size(), {1, 1, 1});
  const SkyErrors errors = sky_errors(sky, picture, truth, kSunAt30);
  const double pi = std::numbers::pi;
  EXPECT_NEAR(errors[SkyRegion::zenith].solid_angle, 2 * pi * (1 - cos(30 * deg)), 1e-12);
  EXPECT_NEAR(errors[SkyRegion::horizon].solid_angle, 2 * pi * sin(10 * deg), 1e-12);
  EXPECT_NEAR(errors[SkyRegion::anti_solar].solid_angle, pi / 2, 1e-12);
  // Cells of 5 deg, counted whole or not at all, about a circle of 15 deg.
  EXPECT_NEAR(errors[SkyRegion::aureole].solid_angle, 2 * pi * (1 - cos(15 * deg)), 0.03);
}

TEST(SkyError, DirectionsBelowTheHorizonDoNotCount) {
  const std::vector<SkyDirection> sky{{enu_direction(0 * deg, 10 * deg), 1 * sr},
                                      {enu_direction(0 * deg, -2 * deg), 1 * sr}};
  const std::vector<TrueRadiance> truth(2, {{1, 1, 1}, {0, 0, 0}});
  const std::vector<glm::dvec3> picture{{1, 1, 1}, {9, 9, 9}};
  EXPECT_EQ(sky_errors(sky, picture, truth, kSunAt30).sky().max, 0);
  const SkyGeometry high{kSunAt30.sun, -3 * deg};
  EXPECT_NEAR(sky_errors(sky, picture, truth, high).sky().max, 8, 1e-12);
}

TEST(SkyError, NinetyFivePercentOfTheSolidAngleStayBelowTheQuantile) {
  std::vector<std::pair<double, double>> values;
  for (int i = 1; i <= 100; ++i) values.emplace_back(i, 1);
  EXPECT_EQ(weighted_quantile(values, 0.95), 95);
  EXPECT_EQ(weighted_quantile({{1, 97}, {2, 3}}, 0.95), 1);
  EXPECT_EQ(weighted_quantile({}, 0.95), 0);
}

/// Noise in the truth adds to the raw rms; taken off, the true error is left. 1296 directions and
/// 200 draws: the mean of the unbiased squares is known to 0.1 %.
TEST(SkyError, NoiseOfTheTruthIsTakenOff) {
  const auto sky = hemisphere();
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const double noise = 0.03, error = 0.01;
  double mean_square = 0, spread = 0, stated = 0;
  constexpr int kDraws = 200;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<TrueRadiance> truth;
    const double se = noise / std::sqrt(3.0);  // of each component, in units of |XYZ| = sqrt(3)
    for (size_t i = 0; i < sky.size(); ++i) {
      const glm::dvec3 off(normal(random), normal(random), normal(random));
      truth.push_back({glm::dvec3(1) + std::sqrt(3.0) * se * off, glm::dvec3(se * std::sqrt(3.0))});
    }
    const std::vector<glm::dvec3> picture(sky.size(), glm::dvec3(1 + error));
    const ErrorMeasure m = sky_errors(sky, picture, truth, kSunAt30).sky();
    EXPECT_NEAR(m.noise, noise, 0.001);
    mean_square += m.rms * m.rms / kDraws;
    spread += (m.rms - error) * (m.rms - error) / kDraws;
    stated += m.rms_uncertainty / kDraws;
  }
  // The noisy truth is the denominator too: to second order the mean square is that of
  // (e - n) / (1 + n), which is e^2 + s^2 + 4 e s^2 / 3. At 1 % noise this is 1 % of a 1 % error.
  const double expected = std::sqrt(error * error + 4 * error * noise * noise / 3);
  EXPECT_NEAR(std::sqrt(mean_square), expected, 1e-4);
  EXPECT_NEAR(stated, std::sqrt(spread), 0.35 * stated);
}

}  // namespace
}  // namespace skylapse::study
