#include "sky/bruneton/slice_angles.h"

#include <gtest/gtest.h>

#include <random>

namespace skylapse::sky::bruneton::kernel {
namespace {

TEST(SliceAngles, Atan2IsWithinItsBoundAllRound) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> turn(-3.14159265, 3.14159265), power(-12, 3);
  double worst = 0, worst_relative = 0;
  for (int i = 0; i < 2'000'000; ++i) {
    // Every other angle close to an axis.
    double a = turn(random);
    if (i % 2 == 0) a = std::round(a / 1.5707963267949) * 1.5707963267949 + 1e-3 * a;
    const double r = std::pow(10, power(random));
    const float y = float(r * std::sin(a)), x = float(r * std::cos(a));
    const double expected = std::atan2(double(y), double(x));
    const double error = std::abs(fast_atan2(y, x) - expected);
    worst = std::max(worst, error);
    if (expected != 0) worst_relative = std::max(worst_relative, error / std::abs(expected));
  }
  EXPECT_LT(worst, 4e-7);
  EXPECT_LT(worst_relative, 3e-7);
}

TEST(SliceAngles, Atan2OfTheOriginIsZero) {
  EXPECT_EQ(fast_atan2(0.0f, 0.0f), 0.0f);
  EXPECT_EQ(fast_atan2(0.0f, 1.0f), 0.0f);
  EXPECT_NEAR(fast_atan2(0.0f, -1.0f), 3.14159265f, 3e-7);
}

TEST(SliceAngles, PowerIsWithinItsBoundOverAllMagnitudes) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> power(-22, 0);
  double worst = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    const float v = float(std::pow(10, power(random)));
    const double expected = std::pow(double(v), 2.0 / 3);
    worst = std::max(worst, std::abs(power_two_thirds(v) / expected - 1));
  }
  EXPECT_LT(worst, 5e-7);
  EXPECT_NEAR(power_two_thirds(1.0f), 1.0f, 3e-7);
  EXPECT_LT(power_two_thirds(0.0f), 1e-19f);
}

}  // namespace
}  // namespace skylapse::sky::bruneton::kernel
