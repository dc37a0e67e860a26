#include "color/dither.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.h"

namespace skylapse::color {
namespace {

std::vector<float> flat(size_t width, size_t height, float value) {
  return std::vector<float>(3 * width * height, value);
}

std::vector<uint8_t> dithered(const std::vector<float>& rgb, size_t width, size_t height,
                              uint64_t seed) {
  std::vector<uint8_t> out(rgb.size());
  quantise_u8(rgb.data(), width, height, seed, out.data());
  return out;
}

template <class T>
double mean(const std::vector<T>& values) {
  double sum = 0;
  for (const T v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

constexpr size_t kSide = 256;
constexpr double kSamples = 3.0 * kSide * kSide;
// Variance of the error of triangular dither: two uniforms and the rounding, 3/12 of a code squared
// (Lipshitz et al. 1992); a mean over the patch then spreads by sigma / sqrt(n). Five sigma.
const double kMeanTolerance = 5.0 * std::sqrt(0.25 / kSamples);

TEST(Dither, MeanIsKeptAtEveryLevelEndsIncluded) {
  for (const double code :
       {0.02, 0.1, 0.25, 0.49, 0.5, 0.77, 1.0, 1.3, 10.5, 127.123, 253.9, 254.5, 254.75, 254.95}) {
    const auto out =
        dithered(flat(kSide, kSide, static_cast<float>(code / 255.0)), kSide, kSide, 7);
    EXPECT_NEAR(mean(out), code, kMeanTolerance) << "at code " << code;
  }
}

TEST(Dither, SixteenBitMeanIsKept) {
  for (const double code : {0.3, 0.5, 1.75, 1000.25, 32768.4, 65534.6}) {
    const auto rgb = flat(kSide, kSide, static_cast<float>(code / 65535.0));
    std::vector<uint16_t> out(rgb.size());
    quantise_u16(rgb.data(), kSide, kSide, 7, out.data());
    // A float of 0..1 resolves 65535 codes to 1/256 in the upper half.
    const double stored = static_cast<double>(rgb[0]) * 65535.0;
    EXPECT_NEAR(mean(out), stored, kMeanTolerance + 1.0 / 256) << "at code " << code;
  }
}

TEST(Dither, BlackAndWhiteStayWithoutNoise) {
  for (const uint8_t v : dithered(flat(64, 64, 0.0f), 64, 64, 3)) ASSERT_EQ(v, 0);
  for (const uint8_t v : dithered(flat(64, 64, 1.0f), 64, 64, 3)) ASSERT_EQ(v, 255);
}

TEST(Dither, OutsideIsClampedAndNanIsBlack) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const std::vector<float> rgb{-1.0f, -kInf, std::nanf(""), 1.5f, kInf, 1e30f};
  EXPECT_EQ(dithered(rgb, 2, 1, 0), (std::vector<uint8_t>{0, 0, 0, 255, 255, 255}));
}

TEST(Dither, ErrorNeverReachesTwoCodes) {
  std::vector<float> rgb(3 * 4096);
  for (size_t i = 0; i < rgb.size(); ++i)
    rgb[i] = static_cast<float>(i) / static_cast<float>(rgb.size() - 1);
  const auto out = dithered(rgb, 4096, 1, 11);
  for (size_t i = 0; i < rgb.size(); ++i)
    ASSERT_LT(std::abs(static_cast<double>(out[i]) - 255.0 * static_cast<double>(rgb[i])), 1.5001);
}

TEST(Dither, SameSeedSameBytesAnotherSeedAnotherGrain) {
  const auto grey = flat(97, 31, 0.4321f);
  EXPECT_EQ(dithered(grey, 97, 31, 5), dithered(grey, 97, 31, 5));
  EXPECT_NE(dithered(grey, 97, 31, 5), dithered(grey, 97, 31, 6));
}

TEST(Dither, ThreadsDoNotChangeTheBytes) {
  const auto grey = flat(333, 517, 0.777f);
  const auto all_cores = dithered(grey, 333, 517, 9);
  const ThreadLimit one(1);
  EXPECT_EQ(dithered(grey, 333, 517, 9), all_cores);
}

// A sky that darkens by two codes over 512 columns: rounding alone would give three flat bands.
TEST(Dither, SlowGradientShowsNoBands) {
  constexpr size_t kWidth = 512;
  constexpr size_t kHeight = 512;
  std::vector<float> rgb(3 * kWidth * kHeight);
  for (size_t y = 0; y < kHeight; ++y)
    for (size_t i = 0; i < 3 * kWidth; ++i)
      rgb[3 * kWidth * y + i] =
          static_cast<float>((100.0 + 2.0 * static_cast<double>(i / 3) / kWidth) / 255.0);
  const auto out = dithered(rgb, kWidth, kHeight, 21);
  constexpr size_t kBlock = 16;
  for (size_t x0 = 0; x0 < kWidth; x0 += kBlock) {
    double got = 0;
    double wanted = 0;
    for (size_t y = 0; y < kHeight; ++y)
      for (size_t i = 3 * x0; i < 3 * (x0 + kBlock); ++i) {
        got += out[3 * kWidth * y + i];
        wanted += 255.0 * static_cast<double>(rgb[3 * kWidth * y + i]);
      }
    constexpr double kCount = 3.0 * kBlock * kHeight;
    EXPECT_NEAR(got / kCount, wanted / kCount, 5.0 * std::sqrt(0.25 / kCount)) << "column " << x0;
  }
}

TEST(Dither, NeighboursChannelsAndFramesAreUncorrelated) {
  const auto grey = flat(kSide, kSide, 0.5f);
  const auto a = dithered(grey, kSide, kSide, 100);
  const auto b = dithered(grey, kSide, kSide, 101);
  const double level = 127.5;
  const auto correlation = [&](const std::vector<uint8_t>& u, const std::vector<uint8_t>& v,
                               size_t shift) {
    double sum = 0;
    for (size_t i = 0; i + shift < u.size(); ++i) sum += (u[i] - level) * (v[i + shift] - level);
    return sum / static_cast<double>(u.size() - shift);
  };
  const double limit = 5.0 * 0.25 / std::sqrt(kSamples);  // five sigma of a product of independents
  EXPECT_NEAR(correlation(a, b, 0), 0.0, limit) << "next frame";
  for (const size_t shift : {size_t{1}, size_t{2}, size_t{3}, size_t{6}, 3 * kSide, 3 * kSide + 3})
    EXPECT_NEAR(correlation(a, a, shift), 0.0, limit) << "shift " << shift;
}

TEST(Dither, NoiseVarianceDoesNotDependOnTheLevel) {
  // The point of triangular noise: grain does not come and go with the signal.
  for (const double code : {50.0, 50.25, 50.5, 50.9}) {
    const auto out =
        dithered(flat(kSide, kSide, static_cast<float>(code / 255.0)), kSide, kSide, 4);
    double variance = 0;
    for (const uint8_t v : out) variance += (v - code) * (v - code);
    // The fourth moment of this error is below 0.2, so five sigma of the mean square are:
    EXPECT_NEAR(variance / kSamples, 0.25, 5.0 * std::sqrt(0.2 / kSamples)) << "at code " << code;
  }
}

}  // namespace
}  // namespace skylapse::color
