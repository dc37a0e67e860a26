#include "astro/event_search.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skylapse::astro::test {
namespace {

constexpr double kDay = 86400;

TEST(SampledCurve, FindsSimpleCrossingsToATenthOfAMillisecond) {
  const SampledCurve wave([](double t) { return std::sin(2 * M_PI * (t - 1234.5) / kDay); }, 0,
                          kDay, 600);
  const auto c = wave.crossings(0);
  ASSERT_EQ(c.size(), 2u);
  EXPECT_NEAR(c[0].time_s, 1234.5, 1e-4);
  EXPECT_NEAR(c[1].time_s, 1234.5 + kDay / 2, 1e-4);
  EXPECT_TRUE(c[0].rising);
  EXPECT_FALSE(c[1].rising);
}

TEST(SampledCurve, SeesAPeakThatPassesTheLevelForOneSecondBetweenSamples) {
  const double peak = 40123.4;
  const auto parabola = [&](double t) { return -(t - peak) * (t - peak); };
  const auto c = SampledCurve(parabola, 0, kDay, 600).crossings(-0.25);
  ASSERT_EQ(c.size(), 2u);
  EXPECT_NEAR(c[0].time_s, peak - 0.5, 2e-3);
  EXPECT_NEAR(c[1].time_s, peak + 0.5, 2e-3);
  EXPECT_TRUE(SampledCurve(parabola, 0, kDay, 600).crossings(1e-3).empty());
}

TEST(SampledCurve, SeesAPeakInTheFirstAndInTheLastStep) {
  for (const double peak : {0.7, kDay - 0.7}) {
    const auto c = SampledCurve([&](double t) { return -(t - peak) * (t - peak); }, 0, kDay, 600)
                       .crossings(-0.01);
    EXPECT_EQ(c.size(), 2u) << peak;
  }
}

TEST(SampledCurve, BeginBelongsToTheIntervalAndEndDoesNot) {
  const auto line = [](double t) { return t; };
  EXPECT_EQ(SampledCurve(line, 1000, 2000, 600).crossings(1500).size(), 1u);
  EXPECT_TRUE(SampledCurve(line, 1000, 2000, 600).crossings(2001).empty());
  EXPECT_TRUE(SampledCurve(line, 1000, 2000, 600).crossings(999).empty());
}

TEST(SampledCurve, AJumpCountsAsOneCrossing) {
  const auto c =
      SampledCurve([](double t) { return t < 777 ? -1.0 : 1.0; }, 0, 3600, 600).crossings(0);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_NEAR(c[0].time_s, 777, 1e-4);
}

}  // namespace
}  // namespace skylapse::astro::test
