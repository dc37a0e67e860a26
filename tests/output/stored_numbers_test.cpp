#include "output/stored_numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "output/image_fixture.h"

namespace skylapse::output {
namespace {

/// Magnitudes over many decades, as a sky with its sun has them.
std::vector<float> decades(float lowest_log2, float highest_log2) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> exponent(lowest_log2, highest_log2);
  std::vector<float> rgb(size_t{3} * kWidth * kHeight);
  for (float& v : rgb) v = std::exp2(exponent(random));
  return rgb;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(StoredNumbers, HalvesAreThoseOfTheFileBitForBit) {
  auto rgb = decades(-30, 15.9F);
  rgb[0] = 65504, rgb[1] = 0, rgb[2] = -1.0F / 3, rgb[3] = 0x1p-24F, rgb[4] = 0x1.8p-25F;
  rgb[5] = 0x1p-25F, rgb[6] = 2049, rgb[7] = 2051;  // ties
  const auto bytes = image_io().encode(request("exr", SampleType::half_float, rgb.data()));
  ASSERT_TRUE(bytes.ok());
  const auto stored = decode_bytes(*bytes, "exr");
  round_to_half(rgb);
  EXPECT_TRUE(same_bits(stored->pixels.data(), rgb));
}

TEST(StoredNumbers, HalvesBeyondTheLargestBecomeInfiniteAndNanStays) {
  EXPECT_EQ(rounded_to_half(65519.99F), 65504.0F);
  EXPECT_TRUE(std::isinf(rounded_to_half(65520.0F)));
  EXPECT_EQ(rounded_to_half(-1e9F), -std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(rounded_to_half(std::nanf(""))));
}

TEST(StoredNumbers, RgbePixelsAreThoseOfTheFileBitForBit) {
  auto rgb = decades(-20, 30);
  for (int c = 0; c < 3; ++c) rgb[c] = 0, rgb[3 + c] = 255.9F, rgb[6 + c] = kLargestRgbe;
  rgb[9] = -5, rgb[10] = 1e-3F, rgb[11] = 0;
  const auto bytes = image_io().encode(request("hdr", SampleType::float32, rgb.data()));
  ASSERT_TRUE(bytes.ok()) << format_error(bytes.error());
  const auto stored = decode_bytes(*bytes, "hdr");
  round_to_rgbe(rgb);
  EXPECT_TRUE(same_bits(stored->pixels.data(), rgb));
  EXPECT_EQ(rgb[3], 256.0F);  // rounded up into the next exponent
  EXPECT_EQ(rgb[6], kLargestRgbe);
}

/// A writer that cuts off, as most do, loses 0.2 % of the light.
TEST(StoredNumbers, RgbeIsWithinHalfAStepAndRightOnAverage) {
  const auto before = decades(-10, 20);
  auto rgb = before;
  round_to_rgbe(rgb);
  double error = 0;
  for (size_t i = 0; i < rgb.size(); i += 3) {
    const float largest = std::max({before[i], before[i + 1], before[i + 2]});
    for (size_t c = i; c < i + 3; ++c) EXPECT_LE(std::fabs(rgb[c] - before[c]), largest / 256);
    error += (rgb[i] - before[i]) / largest / double(rgb.size() / 3);
  }
  // A step is 1/128 to 1/256, its error 1/12 squared: 0.0016 a pixel, 851 pixels; 4 sigma.
  EXPECT_LT(std::fabs(error), 4 * 0.0016 / std::sqrt(851.0));
}

TEST(StoredNumbers, RgbeRefusesWhatItCannotHold) {
  for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity(), 3e38F}) {
    auto rgb = gradient();
    rgb[17] = bad;
    const auto bytes = image_io().encode(request("hdr", SampleType::float32, rgb.data()));
    ASSERT_FALSE(bytes.ok()) << bad;
    EXPECT_EQ(bytes.error().code, ErrorCode::invalid_input);
  }
}

}  // namespace
}  // namespace skylapse::output
