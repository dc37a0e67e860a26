// The bounds that flip_math.h states.
#include "image/diff/flip_math.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skylapse::image::flip_internal {
namespace {

/// Positive floats over the whole range, denser than any polynomial's wiggles.
template <class Check>
void for_floats(float from, float to, Check check) {
  for (float x = from; x < to; x *= 1.00037f) check(x);
}

TEST(FlipMath, Log2IsWithinItsBound) {
  for_floats(kSmallestNormal, 3e38f, [](float x) {
    const double exact = std::log2(double(x));
    ASSERT_NEAR(log2_of(x), exact, 1e-7 + 6e-8 * std::fabs(exact)) << x;
  });
  EXPECT_EQ(log2_of(1), 0);
}

TEST(FlipMath, Exp2IsWithinItsBound) {
  for (double x = -126; x < 127; x += 0.000917) {
    const double exact = std::exp2(double(float(x)));
    ASSERT_NEAR(exp2_of(float(x)) / exact, 1, 2e-7) << x;
  }
  EXPECT_EQ(exp2_of(-1e9f), 0x1p-126f);
  EXPECT_EQ(exp2_of(1e9f), 0x1p127f);
}

TEST(FlipMath, PowersAreWithinTheirBound) {
  for (const float y : {0.02f, 0.5f, 0.7f, 1.0f, 2.4f})
    for_floats(1e-12f, 300.0f, [y](float x) {
      const double bound = 4e-7 + 9e-8 * std::fabs(y * std::log2(double(x)));
      ASSERT_NEAR(power_of(x, y) / std::pow(double(x), double(y)), 1, bound) << x << "^" << y;
    });
  EXPECT_EQ(power_of(0, 0.7f), 0);
  EXPECT_EQ(power_of(1, 0.7f), 1);
}

TEST(FlipMath, CubeRootIsWithinItsBound) {
  for_floats(1e-3f, 10.0f,
             [](float x) { ASSERT_NEAR(cube_root(x) / std::cbrt(double(x)), 1, 3e-7) << x; });
}

}  // namespace
}  // namespace skylapse::image::flip_internal
