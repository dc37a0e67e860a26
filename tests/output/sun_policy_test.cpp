#include "output/sun_policy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace skylapse::output {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

/// 4 x 2 pixels of radiance 10, one pixel of the sun.
image::FrameBuffer with_sun(float sun) {
  image::FrameBuffer frame(4, 2);
  for (float& v : frame.data()) v = 10.0f;
  for (int c = 0; c < 3; ++c) frame.pixel(2, 1)[c] = sun;
  return frame;
}

TEST(SunPolicy, RefuseAcceptsWhatFitsAndNamesWhatDoesNot) {
  auto fits = with_sun(65504.0f);
  EXPECT_TRUE(apply_sun_policy(fits, SunPolicy::refuse).ok());
  auto bright = with_sun(1.5e6f);
  const auto refused = apply_sun_policy(bright, SunPolicy::refuse);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::invalid_input);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("1500000"));
}

TEST(SunPolicy, ClipCountsPixelsAndTheLostShare) {
  auto frame = with_sun(1.0e6f);
  const auto record = apply_sun_policy(frame, SunPolicy::clip);
  ASSERT_TRUE(record.ok());
  EXPECT_EQ(record->pixels_beyond_half, 1);
  EXPECT_EQ(frame.pixel(2, 1)[0], 65504.0f);
  EXPECT_EQ(frame.pixel(0, 0)[0], 10.0f);
  const double before = 21 * 10.0 + 3 * 1.0e6;
  EXPECT_NEAR(record->lost_fraction, 3 * (1.0e6 - 65504.0) / before, 1e-12);
}

TEST(SunPolicy, ScaleIsTheLargestPowerOfTwoThatFitsAndLosesNothing) {
  for (const float sun : {65505.0f, 131008.0f, 131009.0f, 1.9e9f, 3.4e38f}) {
    auto frame = with_sun(sun);
    const auto record = apply_sun_policy(frame, SunPolicy::scale);
    ASSERT_TRUE(record.ok());
    const double scale = record->scale;
    EXPECT_EQ(std::exp2(std::round(std::log2(scale))), scale);
    EXPECT_LE(scale * static_cast<double>(sun), 65504.0);
    EXPECT_GT(2 * scale * static_cast<double>(sun), 65504.0);
    EXPECT_EQ(static_cast<double>(frame.pixel(2, 1)[0]), scale * static_cast<double>(sun));
    EXPECT_EQ(record->lost_fraction, 0.0);
  }
}

/// Luminance of a moonless night: 1e-4 cd/m^2 is 1.5e-7.
image::FrameBuffer night() {
  image::FrameBuffer frame(4, 2);
  for (size_t i = 0; i < frame.data().size(); ++i) frame.data()[i] = 4e-8f + 1e-9f * float(i);
  return frame;
}

TEST(SunPolicy, ScaleLiftsWhatIsTooDarkForHalfFloatsAndOnlyForThem) {
  RangeSurvey survey;
  const auto frame = night();
  survey.add(frame.data(), frame.data(), frame.width());
  EXPECT_TRUE(survey.underflows_half());
  const auto half = decide_sun_policy(survey, SunPolicy::scale);
  ASSERT_TRUE(half.ok());
  EXPECT_GT(half->scale, 1e11);
  EXPECT_EQ(std::exp2(std::round(std::log2(half->scale))), half->scale);
  EXPECT_EQ(decide_sun_policy(survey, SunPolicy::scale, false)->scale, 1.0);
  RangeSurvey day;
  const auto bright = with_sun(60000.0f);
  day.add(bright.data(), bright.data(), bright.width());
  EXPECT_FALSE(day.underflows_half());
}

TEST(SunPolicy, RefuseLetsNoNightVanishInHalfFloats) {
  RangeSurvey survey;
  const auto frame = night();
  survey.add(frame.data(), frame.data(), frame.width());
  EXPECT_FALSE(decide_sun_policy(survey, SunPolicy::refuse, true).ok());
  EXPECT_TRUE(decide_sun_policy(survey, SunPolicy::refuse, false).ok());
}

TEST(SunPolicy, ASurveyInPiecesIsThatOfTheWhole) {
  const auto frame = with_sun(1e6f), sky = with_sun(10.0f);
  RangeSurvey whole, pieces;
  whole.add(frame.data(), sky.data(), 4);
  for (int y = 0; y < 2; ++y) pieces.add({frame.row(y), 12}, {sky.row(y), 12}, 4);
  EXPECT_EQ(pieces.sum, whole.sum);
  EXPECT_EQ(pieces.kept_sum, whole.kept_sum);
  EXPECT_EQ(pieces.half_sum, whole.half_sum);
  EXPECT_EQ(pieces.largest, whole.largest);
  EXPECT_EQ(pieces.pixels_beyond_half, 1);
  EXPECT_EQ(pieces.kept_beyond_half, 0);
}

TEST(SunPolicy, ScaleLeavesFittingImagesAlone) {
  auto frame = with_sun(65504.0f);
  const auto record = apply_sun_policy(frame, SunPolicy::scale);
  ASSERT_TRUE(record.ok());
  EXPECT_EQ(record->scale, 1.0);
  EXPECT_EQ(frame.data(), with_sun(65504.0f).data());
}

TEST(SunPolicy, InfiniteRadianceCannotBeScaledButClipped) {
  auto frame = with_sun(kInf);
  EXPECT_FALSE(apply_sun_policy(frame, SunPolicy::scale).ok());
  const auto record = apply_sun_policy(frame, SunPolicy::clip);
  ASSERT_TRUE(record.ok());
  EXPECT_EQ(frame.pixel(2, 1)[1], 65504.0f);
  EXPECT_EQ(record->lost_fraction, 1.0);
}

TEST(SunPolicy, SplitLeavesTheSkyAndRecordsTheDiscsShare) {
  auto frame = with_sun(1.0e6f);
  const auto sky = with_sun(10.0f);
  const auto record = apply_sun_policy(frame, SunPolicy::split, &sky);
  ASSERT_TRUE(record.ok());
  EXPECT_EQ(frame.data(), sky.data());
  EXPECT_EQ(record->pixels_beyond_half, 0);
  EXPECT_NEAR(record->lost_fraction, 1.0 - 240.0 / (210.0 + 3.0e6), 1e-12);
}

TEST(SunPolicy, NanIsNeitherCountedNorChanged) {
  auto frame = with_sun(std::nanf(""));
  EXPECT_FALSE(exceeds_half(frame));
  const auto record = apply_sun_policy(frame, SunPolicy::clip);
  ASSERT_TRUE(record.ok());
  EXPECT_EQ(record->pixels_beyond_half, 0);
  EXPECT_TRUE(std::isnan(frame.pixel(2, 1)[2]));
}

}  // namespace
}  // namespace skylapse::output
