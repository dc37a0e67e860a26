#include "diff/packed_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "diff/sample_pictures.h"
#include "diff/shrink.h"

namespace skylapse::diff {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();
constexpr float kLargest = std::numeric_limits<float>::max();

float through_code(float value, int mantissa) {
  const Codes codes = float_codes(std::span(&value, 1), 1, 1, 1, mantissa);
  return float_of_code(codes.values[0], codes.bits);
}

TEST(FloatCodes, AreOffByAtMostHalfAStepFromAirglowToSuns) {
  for (const int mantissa : {3, 11})
    for (double size = 1e-30; size < 1e38; size *= 1.37)
      for (const double sign : {-1.0, 1.0}) {
        const float value = float(sign * size);
        EXPECT_NEAR(through_code(value, mantissa), value, std::ldexp(size, -mantissa - 1) * 1.0001);
      }
}

TEST(FloatCodes, KeepWhatIsNoNumberAndStayFinite) {
  EXPECT_TRUE(std::isnan(through_code(kNotANumber, 11)));
  EXPECT_TRUE(std::isnan(through_code(-kNotANumber, 3)));
  EXPECT_EQ(through_code(kInfinite, 11), kInfinite);
  EXPECT_EQ(through_code(-kInfinite, 3), -kInfinite);
  EXPECT_TRUE(std::isfinite(through_code(kLargest, 3)));
  EXPECT_TRUE(std::isfinite(through_code(-kLargest, 11)));
  EXPECT_EQ(std::signbit(through_code(-0.0f, 11)), false);
}

TEST(PackedCodes, OfEqualPicturesTakeNextToNothing) {
  const auto sky = sample_sky(180);
  const Codes codes = float_codes(sky.samples, 256, 128, 3, 11);
  const PackedCodes b = packed(codes, &codes);
  EXPECT_EQ(b.prediction, Prediction::base);
  EXPECT_LT(b.text.size(), 1000u);
}

TEST(PackedCodes, OfASmoothSkyTakeAThirdOfItsHalfFloats) {
  const auto sky = sample_sky(180);
  const size_t bytes = packed(float_codes(sky.samples, 256, 128, 3, 11), nullptr).text.size();
  EXPECT_LT(bytes, 256 * 128 * 3 * 2 / 3);
}

TEST(PackedCodes, AreThereForEverySize) {
  for (const int size : {0, 1, 3}) {
    const std::vector<float> samples(size_t(size) * size, 1.0f);
    EXPECT_FALSE(packed(float_codes(samples, size, size, 1, 11), nullptr).text.empty());
  }
}

TEST(Shrunk, KeepsWhatIsNoNumberAndWhatIsNegative) {
  const auto sky = changed(sample_sky(180), [](float* rgb, int x, int y) {
    if (x == 200 && y == 100) rgb[1] = kNotANumber;
    if (x == 20 && y == 20) rgb[0] = -kInfinite;
    if (x == 60 && y == 60) rgb[2] = -1;
    if (x == 61 && y == 60) rgb[2] = kInfinite;
    if (x == 7 && y == 7) rgb[0] = -2;
  });
  const auto small = shrunk(sky, 4, 3);
  EXPECT_EQ(small.width, 64);
  EXPECT_EQ(small.height, 32);
  EXPECT_TRUE(std::isnan(small.pixel(50, 25)[1]));
  EXPECT_EQ(small.pixel(5, 5)[0], -kInfinite);
  EXPECT_EQ(small.pixel(15, 15)[2], kInfinite);
  EXPECT_EQ(small.pixel(1, 1)[0], -2);
  EXPECT_TRUE(std::isfinite(small.pixel(50, 25)[0]));
}

TEST(Shrunk, IsTheMeanAndRoundsSizesUp) {
  image::Picture p;
  p.width = 3, p.height = 1, p.channels = {"Y"}, p.samples = {1, 2, 7};
  const auto small = shrunk(p, 2, 1);
  EXPECT_EQ(small.samples, (std::vector<float>{1.5, 7}));
  EXPECT_EQ(shrunk(p, 1, 1).samples, p.samples);
}

TEST(Shrunk, MapsKeepTheLargestErrorWithItsSign) {
  const std::vector<float> errors{0.1f, -0.5f, 0, kInfinite, 0, 0.2f, kNotANumber, 0};
  const auto small = shrunk_by_largest(errors, 4, 2, 2);
  EXPECT_EQ(small[0], -0.5f);
  EXPECT_TRUE(std::isnan(small[1]) || std::isinf(small[1]));
}

TEST(Shrunk, FactorHoldsWidthAndPixels) {
  EXPECT_EQ(shrink_factor(1024, 512, 1024), 1);
  EXPECT_EQ(shrink_factor(1025, 2, 1024), 2);
  EXPECT_EQ(shrink_factor(16384, 8192, 1024), 16);
  EXPECT_EQ(shrink_factor(1024, 6144, 1024), 3);
  EXPECT_EQ(shrink_factor(1, 1, 1024), 1);
}

}  // namespace
}  // namespace skylapse::diff
