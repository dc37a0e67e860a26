#include "color/exposure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skylapse::color {
namespace {

TEST(Exposure, MiddleGreyIsWhatTheMeterReads) {
  for (const double l : {0.01, 1.0, 4000.0, 1e6})
    EXPECT_NEAR(l * exposure_scale_per_cd_m2(metered_ev(l * cd_per_m2)), 0.18, 1e-12);
}

TEST(Exposure, OneStopHalvesTheScale) {
  EXPECT_NEAR(exposure_scale_per_cd_m2(11) / exposure_scale_per_cd_m2(12), 2, 1e-12);
}

TEST(Exposure, SunnySixteenIsEvFifteen) {
  // A surface of 4096 cd/m^2: EV 15, by ISO 2720 with K = 12.5.
  EXPECT_NEAR(metered_ev(4096 * cd_per_m2), 15, 1e-12);
  EXPECT_NEAR(exposure_time_at_f8(15).in(second), 64.0 / 32768, 1e-12);
}

TEST(Exposure, SunCurveDarkensDuskByAboutAStopAndNightByThree) {
  const double noon = 5000 * exposure_scale_per_cd_m2(sun_curve_ev(5000 * cd_per_m2));
  const double dusk = 30 * exposure_scale_per_cd_m2(sun_curve_ev(30 * cd_per_m2));
  const double night = 2e-4 * exposure_scale_per_cd_m2(sun_curve_ev(2e-4 * cd_per_m2));
  EXPECT_NEAR(std::log2(noon / dusk), 1.0, 0.2);
  EXPECT_NEAR(std::log2(noon / night), 3.0, 0.6);
}

TEST(Exposure, DarknessHasAnExposure) {
  EXPECT_TRUE(std::isfinite(metered_ev(0 * cd_per_m2)));
  EXPECT_TRUE(std::isfinite(sun_curve_ev(0 * cd_per_m2)));
}

TEST(FollowMeter, NeverExceedsItsRateAndReachesASteadyTarget) {
  std::vector<MeteredFrame> frames;
  for (int i = 0; i < 100; ++i) frames.push_back({double(i) * minute, i < 10 ? 15.0 : 5.0});
  const auto evs = follow_meter(frames, 0.25);
  EXPECT_EQ(evs.front(), 15.0);
  for (size_t i = 1; i < evs.size(); ++i) EXPECT_LE(std::abs(evs[i] - evs[i - 1]), 0.25 + 1e-12);
  EXPECT_DOUBLE_EQ(evs.back(), 5.0);
}

TEST(FollowMeter, NothingAndOneFrameAreFine) {
  EXPECT_TRUE(follow_meter({}, 1).empty());
  EXPECT_EQ(follow_meter({{0 * second, 7}}, 1), std::vector<double>{7});
}

}  // namespace
}  // namespace skylapse::color
