// What FLIP promises beside the published numbers: laws, and an answer for every picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/parallel.h"
#include "image/diff/flip.h"
#include "image/diff/flip_pairs.h"
#include "image/diff/flip_tiles.h"

namespace skylapse::image {
namespace {

using Limits = std::numeric_limits<float>;

/// In [0, 1), the same numbers for the same seed.
class Noise {
 public:
  explicit Noise(uint32_t seed) : state_(seed) {}
  float operator()() {
    state_ = 1664525 * state_ + 1013904223;
    return float(state_ >> 8) / 16777216.0f;
  }

 private:
  uint32_t state_;
};

Picture filled(int width, int height, float value) {
  Picture picture = linear_picture(width, height);
  std::ranges::fill(picture.samples, value);
  return picture;
}

/// A sky over four decades of light with a disc of 3 pixels across.
Picture sky(int width, int height, float disc = 5000) {
  Picture picture = linear_picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float d = std::hypot(float(x - width / 3), float(y - height / 4));
      const float light = 0.1f + 4 / (1 + d * d / 50) + (d < 1.5f ? disc : 0);
      float* p = &picture.samples[3 * (size_t(y) * size_t(width) + size_t(x))];
      const float ground = y > 3 * height / 4 ? 0.1f : 1;
      p[0] = light * ground;
      p[1] = 1.3f * light * ground;
      p[2] = (0.5f + 1.2f * light) * ground;
    }
  return picture;
}

Picture times_noise(Picture picture, float amount, uint32_t seed = 7) {
  Noise noise(seed);
  for (float& v : picture.samples) v *= 1 + amount * (2 * noise() - 1);
  return picture;
}

Picture shown(Picture picture) {
  picture.display_referred = true;
  for (float& v : picture.samples) v = std::round(255 * v / (1 + v)) / 255;
  return picture;
}

FlipOptions from_to(double start, double stop, int exposures) {
  FlipOptions options;
  options.start = start;
  options.stop = stop;
  options.exposures = exposures;
  return options;
}

void expect_finite_share(const FlipResult& result) {
  for (const float e : result.map) {
    ASSERT_GE(e, 0);
    ASSERT_LE(e, 1);
  }
  for (const double v : {result.mean, result.weighted_quartile_1, result.weighted_median,
                         result.weighted_quartile_3, result.start, result.stop})
    EXPECT_TRUE(std::isfinite(v));
  EXPECT_LE(result.minimum, result.mean);
  EXPECT_LE(result.mean, result.maximum);
}

void expect_nothing(const FlipResult& result) {
  EXPECT_EQ(result.maximum, 0);
  EXPECT_EQ(result.mean, 0);
  EXPECT_EQ(result.weighted_median, 0);
}

TEST(FlipLaws, EqualPicturesDifferByExactlyNothing) {
  const Picture a = times_noise(sky(300, 150), 0.5f);
  for (const auto mapper : {ToneMapper::aces, ToneMapper::hable, ToneMapper::reinhard}) {
    FlipOptions options;
    options.tone_mapper = mapper;
    expect_nothing(flip(a, a, options));
  }
  expect_nothing(flip(shown(a), shown(a)));
}

TEST(FlipLaws, ChangeIsSeenAsFarAsTheFiltersReachAndNowhereElse) {
  const Picture a = times_noise(sky(300, 150), 0.1f);
  Picture b = a;
  b.samples[3 * (70 * 300 + 130)] *= 1.5f;
  const FlipResult result = flip(a, b);
  const int reach = flip_internal::filters_for(kFlipPixelsPerDegree).radius;
  EXPECT_EQ(reach, 10);
  for (int y = 0; y < 150; ++y)
    for (int x = 0; x < 300; ++x) {
      const bool near = std::abs(x - 130) <= reach && std::abs(y - 70) <= reach;
      ASSERT_TRUE(near || result.map[size_t(y) * 300 + size_t(x)] == 0) << x << " " << y;
    }
  EXPECT_GT(result.map[70 * 300 + 130], 0);
  EXPECT_EQ(result.max_x, 130);
  EXPECT_EQ(result.max_y, 70);
}

TEST(FlipLaws, ExchangingThePicturesChangesNothingAtGivenOrOwnExposures) {
  const Picture a = sky(200, 100), b = times_noise(a, 0.2f);
  for (const auto mapper : {ToneMapper::aces, ToneMapper::hable, ToneMapper::reinhard}) {
    FlipOptions fixed = from_to(-6, 2, 5);
    fixed.tone_mapper = mapper;
    FlipOptions own;
    own.tone_mapper = mapper;
    EXPECT_EQ(flip(a, b, fixed).map, flip(b, a, fixed).map);
    EXPECT_EQ(flip(a, b, own).map, flip(b, a, own).map);
  }
  EXPECT_EQ(flip(shown(a), shown(b)).map, flip(shown(b), shown(a)).map);
}

TEST(FlipLaws, AnyNumberOfThreadsGivesTheSameBits) {
  const Picture a = sky(600, 300), b = times_noise(a, 0.2f);
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return flip(a, b);
  };
  const FlipResult one = with(1), two = with(2), seven = with(7);
  EXPECT_EQ(one.map, two.map);
  EXPECT_EQ(one.map, seven.map);
  EXPECT_EQ(one.mean, seven.mean);
  EXPECT_EQ(one.weighted_quartile_3, seven.weighted_quartile_3);
}

/// `inner` at a place of a constant frame, which is large enough to be worked on in pieces.
Picture placed(const Picture& inner, int x0, int y0) {
  Picture frame = filled(700, 400, 0.4f);
  for (int y = 0; y < inner.height; ++y)
    std::copy_n(inner.pixel(0, y), 3 * inner.width,
                frame.samples.begin() + 3 * ((y0 + y) * frame.width + x0));
  return frame;
}

TEST(FlipLaws, MapsMoveWithThePicturesSoThatPiecesLeaveNoSeam) {
  const Picture a = sky(400, 200), b = times_noise(a, 0.2f);
  const FlipOptions options = from_to(-3, 2, 2);
  const FlipResult here = flip(placed(a, 20, 20), placed(b, 20, 20), options);
  const int right = 217, down = 151;
  const FlipResult there =
      flip(placed(a, 20 + right, 20 + down), placed(b, 20 + right, 20 + down), options);
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 440; ++x)
      ASSERT_EQ(here.map[size_t(y * 700 + x)], there.map[size_t((y + down) * 700 + x + right)])
          << x << " " << y;
}

TEST(FlipLaws, GreyCountsAsThreeEqualChannelsAndOthersPlayNoPart) {
  const Picture light = sky(60, 40);
  Picture grey = light, rgb = light, with_depth = light;
  grey.channels = {"Y"};
  grey.samples.clear();
  with_depth.channels = {"R", "G", "B", "A", "depth"};
  with_depth.samples.clear();
  for (size_t i = 0; i < light.pixel_count(); ++i) {
    const float v = light.samples[3 * i];
    grey.samples.push_back(v);
    for (size_t c = 0; c < 3; ++c) rgb.samples[3 * i + c] = v;
    with_depth.samples.insert(with_depth.samples.end(), {v, v, v, float(i), Limits::quiet_NaN()});
  }
  const Picture other = times_noise(light, 0.1f);
  const FlipResult expected = flip(rgb, other);
  EXPECT_EQ(flip(grey, other).map, expected.map);
  EXPECT_EQ(flip(with_depth, other).map, expected.map);
}

TEST(FlipLaws, TheFarthestColoursAreOneApartAndNothingIsBeyond) {
  Picture green = filled(40, 40, 0), blue = green;
  green.display_referred = blue.display_referred = true;
  for (size_t i = 0; i < green.pixel_count(); ++i)
    green.samples[3 * i + 1] = blue.samples[3 * i + 2] = 1;
  const FlipResult result = flip(green, blue);
  EXPECT_NEAR(result.minimum, 1, 1e-5);
  EXPECT_LE(result.maximum, 1);
}

/// Rounding noise of an equal picture must not be raised by the exponents 0.5 and 0.7: it is seen
/// at 1e-6 of the light as 1e-4 at most, however structured the picture is.
TEST(FlipLaws, RoundingIsNotMagnified) {
  const Picture a = times_noise(sky(200, 100), 0.3f);
  EXPECT_LT(flip(a, times_noise(a, 1e-6f)).maximum, 5e-4);
  EXPECT_LT(flip(filled(64, 64, 0.4f), times_noise(filled(64, 64, 0.4f), 1e-6f)).maximum, 1e-4);
}

TEST(FlipExposures, AreNotMovedByTheDiscNorByBlackNorBySubnormalNumbers) {
  const Picture weak = sky(300, 150, 100), strong = sky(300, 150, 1e10f);
  const FlipResult plain = flip(weak, times_noise(weak, 0.01f));
  const FlipResult sunny = flip(strong, times_noise(strong, 0.01f));
  EXPECT_EQ(plain.start, sunny.start);
  EXPECT_EQ(plain.stop, sunny.stop);
  EXPECT_EQ(plain.exposures, sunny.exposures);
  Picture subnormal = weak, black = weak;
  for (size_t i = 3 * 300 * 130; i < black.samples.size(); ++i)
    black.samples[i] = 0, subnormal.samples[i] = 1e-39f;
  const FlipResult dark = flip(black, subnormal);
  EXPECT_NEAR(dark.start, plain.start, 0.5);
  expect_nothing(dark);
}

TEST(FlipExposures, AreTwoToSixWhateverTheLight) {
  Noise noise(3);
  for (const float spread : {0.0f, 0.1f, 1.0f, 5.0f, 20.0f, 40.0f}) {
    Picture a = filled(64, 64, 1);
    for (float& v : a.samples) v = std::exp(spread * (noise() - 0.5f));
    const FlipResult result = flip(a, times_noise(a, 0.1f));
    EXPECT_GE(result.exposures, 2) << spread;
    EXPECT_LE(result.exposures, 6) << spread;
    EXPECT_LE((result.stop - result.start) / (result.exposures - 1), 2.4 + 1e-9) << spread;
    expect_finite_share(result);
  }
}

TEST(FlipExposures, ScaleWithTheLight) {
  const Picture a = sky(100, 50), b = times_noise(a, 0.1f);
  const FlipResult plain = flip(a, b);
  for (const int stops : {-90, -20, 3, 60}) {
    Picture scaled_a = a, scaled_b = b;
    for (float& v : scaled_a.samples) v = std::ldexp(v, stops);
    for (float& v : scaled_b.samples) v = std::ldexp(v, stops);
    const FlipResult scaled = flip(scaled_a, scaled_b);
    EXPECT_NEAR(scaled.start, plain.start - stops, 1e-9);
    for (size_t i = 0; i < plain.map.size(); ++i)
      ASSERT_NEAR(scaled.map[i], plain.map[i], 1e-6) << stops;  // of one rounded factor 2^c
  }
}

TEST(FlipExposures, OneIsTheStartAloneAndEndsMayBeEqualOrExchanged) {
  const Picture a = sky(60, 40), b = times_noise(a, 0.1f);
  const FlipResult one = flip(a, b, from_to(1, 5, 1));
  EXPECT_EQ(one.exposures, 1);
  EXPECT_EQ(one.start, 1);
  EXPECT_EQ(one.stop, 1);
  EXPECT_GT(one.maximum, 0);
  EXPECT_EQ(flip(a, b, from_to(1, 1, 2)).map, one.map);
  EXPECT_EQ(flip(a, b, from_to(1, 5, 0)).map, one.map);
  EXPECT_EQ(flip(a, b, from_to(4, -2, 4)).map, flip(a, b, from_to(-2, 4, 4)).map);
  const FlipResult far = flip(a, b, from_to(-1e9, 1e9, 3));
  EXPECT_EQ(far.start, -126);
  EXPECT_EQ(far.stop, 126);
  expect_finite_share(far);
}

TEST(FlipExposures, AsPublishedHaveAnAnswerForNightAndBlackReferences) {
  FlipOptions published;
  published.published_exposures = true;
  Picture night = filled(80, 60, 0), changed = night;
  for (size_t i = 0; i < night.samples.size(); i += 3 * 97) night.samples[i] = 0.3f;
  changed.samples = night.samples;
  changed.samples[3 * 97 * 20] = 0;
  const FlipResult stars = flip(night, changed, published);  // median 0
  EXPECT_GT(stars.maximum, 0.1);
  expect_finite_share(stars);
  const FlipResult from_black = flip(filled(80, 60, 0), night, published);
  EXPECT_GT(from_black.maximum, 0.1);
  expect_finite_share(from_black);
}

TEST(FlipAnswers, BlackPicturesAreComparedExactly) {
  const Picture black = filled(20, 10, 0);
  Picture below = black;
  below.samples[3 * 45 + 1] = -1;
  for (const bool published : {false, true}) {
    FlipOptions options;
    options.published_exposures = published;
    const FlipResult equal = flip(black, black, options);
    EXPECT_EQ(equal.exposures, 0);
    expect_nothing(equal);
    const FlipResult other = flip(black, below, options);
    EXPECT_EQ(other.maximum, 1);
    EXPECT_EQ(other.max_x, 5);
    EXPECT_EQ(other.max_y, 2);
    EXPECT_DOUBLE_EQ(other.mean, 1.0 / 200);
  }
  Picture nan = black;
  nan.samples[0] = Limits::quiet_NaN();
  expect_nothing(flip(nan, nan));
}

TEST(FlipAnswers, BlackAgainstLightIsSeen) {
  const Picture light = sky(60, 40), black = filled(60, 40, 0);
  const FlipResult lost = flip(light, black);
  EXPECT_GT(lost.mean, 0.3);
  EXPECT_EQ(flip(black, light).map, lost.map);
  expect_finite_share(lost);
}

TEST(FlipAnswers, ExistForEverySample) {
  const Picture a = times_noise(sky(60, 40), 0.1f);
  for (const float odd :
       {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), -1.0f, -Limits::max(),
        Limits::max(), Limits::min(), Limits::denorm_min(), 1e10f, 1e-30f, 0.0f, -0.0f})
    for (const auto mapper : {ToneMapper::aces, ToneMapper::hable, ToneMapper::reinhard})
      for (const bool published : {false, true}) {
        Picture b = a;
        b.samples[3 * 700 + 1] = odd;
        std::fill_n(b.samples.begin() + 3 * 1500, 60, odd);
        FlipOptions options;
        options.tone_mapper = mapper;
        options.published_exposures = published;
        expect_finite_share(flip(a, b, options));
        expect_finite_share(flip(b, a, options));
        expect_finite_share(flip(shown(a), shown(b)));
        expect_nothing(flip(b, b, options));
        const Picture all_odd = filled(7, 5, odd);
        expect_finite_share(flip(all_odd, filled(7, 5, 1), options));
        expect_nothing(flip(all_odd, all_odd, options));
      }
}

TEST(FlipAnswers, HugeSunsAreWhiteAndDifferWhereAnExposureReachesThem) {
  const Picture a = sky(60, 40, 1e10f), b = sky(60, 40, 2e10f);
  expect_nothing(flip(a, b));  // white in both at the exposures of the sky
  FlipOptions published;
  published.published_exposures = true;
  EXPECT_GT(flip(a, b, published).maximum, 0.05);
  // Beyond the square root of the largest float, where published programs see black.
  const Picture c = sky(60, 40, 1e20f), black_hole = sky(60, 40, -1e20f);
  EXPECT_GT(flip(c, black_hole).maximum, 0.5);
}

TEST(FlipAnswers, ExistForPicturesSmallerThanEveryFilter) {
  for (const auto& [width, height] : {std::pair{1, 1}, {5, 3}, {1, 40}, {300, 1}, {2, 2}}) {
    const Picture a = sky(width, height), b = times_noise(a, 0.2f);
    const FlipResult result = flip(a, b);
    EXPECT_EQ(result.map.size(), a.pixel_count());
    EXPECT_GT(result.maximum, 0);
    expect_finite_share(result);
    expect_nothing(flip(a, a));
  }
  // One pixel is a constant picture: no features, colours as they are.
  const FlipResult one = flip(filled(1, 1, 0.2f), filled(1, 1, 0.4f), from_to(0, 0, 1));
  const FlipResult many = flip(filled(50, 50, 0.2f), filled(50, 50, 0.4f), from_to(0, 0, 1));
  EXPECT_NEAR(one.maximum, many.mean, 1e-6);
}

TEST(FlipAnswers, ExistAtAnyDistanceFromTheDisplay) {
  const Picture a = sky(120, 60), b = times_noise(a, 0.2f);
  double before = 1;
  for (const double pixels_per_degree : {0.01, 1.0, 5.0, 20.0, 67.0, 100.0, 300.0}) {
    FlipOptions options = from_to(-2, 2, 3);
    options.pixels_per_degree = pixels_per_degree;
    const FlipResult result = flip(a, b, options);
    expect_finite_share(result);
    expect_nothing(flip(a, a, options));
    if (pixels_per_degree >= 5) {
      EXPECT_LT(result.mean, before) << pixels_per_degree;  // noise blurs from afar
      before = result.mean;
    }
  }
}

}  // namespace
}  // namespace skylapse::image
