#include "image/lighting/cube_mips.h"

#include <gtest/gtest.h>

#include <random>

#include "image/camera/cube.h"
#include "image/lighting/sources.h"
#include "skies.h"

namespace skylapse::image {
namespace {

FrameBuffer noise(int side, float brightest) {
  FrameBuffer strip(side, 6 * side);
  std::mt19937 rng(side);
  std::uniform_real_distribution<float> uniform;
  for (float& v : strip.data()) v = uniform(rng);
  strip.data()[5] = brightest;  // a sun
  return strip;
}

TEST(CubeMips, SidesAreHalvedAndRoundedDownAsKtxCounts) {
  EXPECT_EQ(level_side(300, 0), 300);
  EXPECT_EQ(level_side(300, 3), 37);
  EXPECT_EQ(level_side(300, 20), 1);
  EXPECT_EQ(level_count(256, 4), 7);
  EXPECT_EQ(level_count(256, 1), 9);
  EXPECT_EQ(level_count(300, 4), 7);  // 300 150 75 37 18 9 4
  EXPECT_EQ(level_count(1, 4), 1);
}

TEST(CubeMips, EveryLevelHasTheSameFlux) {
  for (const int side : {64, 75, 37, 3, 1}) {
    const auto mips = box_mips(noise(side, 1e6F), level_count(side, 1));
    const glm::dvec3 flux = flux_of(mips.front());
    for (const FrameBuffer& level : mips) {
      EXPECT_EQ(level.height(), 6 * level.width());
      // What is left is the rounding of float pixels.
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(flux_of(level)[c] / flux[c], 1, 3e-7) << side;
    }
    EXPECT_EQ(mips.back().width(), 1);
  }
}

TEST(CubeMips, ConstantSkyStaysConstantExactly) {
  const Camera camera = strip_heading({}, 37);
  const auto sky = cube_of(camera, [](const glm::dvec3&) { return glm::dvec3{0.1, 3e4, 7}; });
  for (const FrameBuffer& level : box_mips(sky, 6))
    for (size_t i = 0; i < level.data().size(); ++i) ASSERT_EQ(level.data()[i], sky.data()[i % 3]);
}

}  // namespace
}  // namespace skylapse::image
