#include "color/false_color.h"

#include <gtest/gtest.h>

#include <limits>

namespace skylapse::color {
namespace {

/// Luma of code values, close enough to lightness to see that it grows (ITU-R BT.709).
double luma(const glm::dvec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

TEST(FalseColor, GrowsInBrightnessFromBlackToLightYellow) {
  double before = -1;
  for (int i = 0; i <= 256; ++i) {
    const double now = luma(inferno(i / 256.0));
    EXPECT_GT(now, before) << i;
    before = now;
  }
  EXPECT_LT(luma(inferno(0)), 1);
  EXPECT_GT(luma(inferno(1)), 230);
}

TEST(FalseColor, HoldsWhatIsBeyondTheEndsAndNaN) {
  EXPECT_EQ(inferno(-3), inferno(0));
  EXPECT_EQ(inferno(7), inferno(1));
  EXPECT_EQ(inferno(std::numeric_limits<double>::quiet_NaN()), inferno(0));
  EXPECT_EQ(inferno(std::numeric_limits<double>::infinity()), inferno(1));
}

}  // namespace
}  // namespace skylapse::color
