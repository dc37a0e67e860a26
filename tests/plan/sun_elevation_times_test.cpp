#include "plan/sun_elevation_times.h"

#include "plan/plan_fixture.h"

using namespace skylapse;
using namespace skylapse::plan::testing;

namespace {

Scene scene_at(const std::string& place, const std::string& time) {
  Scene scene;
  scene.location = "location: {name: here, " + place + "}";
  scene.time = "time: {" + time + "}";
  scene.outputs = "outputs: [{image: \"{site}_{date}_{sun_elevation}_{half}.png\"}]";
  return scene;
}

const std::string kPrague = "latitude: 50.0755, longitude: 14.4378";
const std::string kSolstice = "zone: Europe/Prague, date: 2026-06-21, ";

TEST(SunElevations, TheSunsCentreStandsWhereItWasAsked) {
  const auto plan =
      plan_of(scene_at(kPrague, kSolstice + "sun_elevations: [-18 deg, -4 deg, 0 deg, 60 deg]"));
  // At -18 deg the sun is never that low in this night: noted, not rendered.
  ASSERT_EQ(plan.frames.size(), 6u);
  for (const auto& frame : plan.frames)
    // The crossings are found to 1 ms, in which the sun moves 4e-6 deg.
    EXPECT_NEAR(elevation(frame.sky.sun_true).in(deg), frame.asked_sun->elevation.in(deg), 1e-5);
  ASSERT_EQ(plan.notes.size(), 1u);
  EXPECT_EQ(plan.notes[0],
            "here: the sun's centre does not pass -18 deg on 1 of 1 days (2026-06-21); passed "
            "over");
}

TEST(SunElevations, FramesComeInTheOrderWrittenMorningFirst) {
  const auto plan = plan_of(scene_at(kPrague, kSolstice + "sun_elevations: [30 deg, -4 deg]"));
  ASSERT_EQ(plan.frames.size(), 4u);
  EXPECT_EQ(plan.frames[0].paths[0], "here_2026-06-21_+30.00_morning.png");
  EXPECT_EQ(plan.frames[1].paths[0], "here_2026-06-21_+30.00_afternoon.png");
  EXPECT_EQ(plan.frames[2].paths[0], "here_2026-06-21_-04.00_morning.png");
  EXPECT_EQ(plan.frames[3].paths[0], "here_2026-06-21_-04.00_afternoon.png");
  EXPECT_LT(plan.frames[0].instant, plan.frames[1].instant);
}

TEST(SunElevations, AHalfIsTheRisingOrTheSinkingSun) {
  const auto morning =
      plan_of(scene_at(kPrague, kSolstice + "sun_elevations: [10 deg], half: morning"));
  const auto afternoon =
      plan_of(scene_at(kPrague, kSolstice + "sun_elevations: [10 deg], half: afternoon"));
  ASSERT_EQ(morning.frames.size(), 1u);
  ASSERT_EQ(afternoon.frames.size(), 1u);
  EXPECT_LT(azimuth(morning.frames[0].sky.sun_true), 180 * deg);
  EXPECT_GT(azimuth(afternoon.frames[0].sky.sun_true), 180 * deg);
  // By the calendar of the far side of the Earth the afternoon comes first.
  const auto far = plan_of(scene_at(
      kPrague, "zone: \"-10:00\", date: 2026-06-21, sun_elevations: [10 deg], half: morning"));
  EXPECT_LT(azimuth(far.frames[0].sky.sun_true), 180 * deg);
}

TEST(SunElevations, NothingIsBelowZeroByASign) {
  const auto plan =
      plan_of(scene_at(kPrague, kSolstice + "sun_elevations: [-0 deg], half: morning"));
  EXPECT_EQ(plan.frames[0].paths[0], "here_2026-06-21_+00.00_morning.png");
}

TEST(SunElevations, UnderTheMidnightSunLowElevationsArePassedOver) {
  const auto plan = plan_of(scene_at(
      "latitude: 78.2232, longitude: 15.6267",
      "zone: Arctic/Longyearbyen, dates: 2026-06-20 .. 2026-06-22, sun_elevations: [0 deg, 20 "
      "deg]"));
  ASSERT_EQ(plan.frames.size(), 6u);
  for (const auto& frame : plan.frames) EXPECT_EQ(frame.asked_sun->elevation, 20 * deg);
  ASSERT_EQ(plan.notes.size(), 1u);
  EXPECT_EQ(plan.notes[0],
            "here: the sun's centre does not pass 0 deg on 3 of 3 days (2026-06-20, 2026-06-21, "
            "2026-06-22); passed over");
}

/// At a pole the sun rises for half a year: on a day it passes an elevation once at most.
TEST(SunElevations, AtThePoleTheSunPassesOncePerHalfYear) {
  const auto plan = plan_of(scene_at("latitude: 90, longitude: 0",
                                     "zone: UTC, dates: 2026-03-10 .. 2026-04-10, sun_elevations: "
                                     "[2 deg]"));
  ASSERT_EQ(plan.frames.size(), 1u);
  EXPECT_TRUE(plan.frames[0].asked_sun->rising);
  ASSERT_EQ(plan.notes.size(), 2u);
  EXPECT_NE(plan.notes[0].find("does not rise through 2 deg on 31 of 32 days"), std::string::npos)
      << plan.notes[0];
  EXPECT_NE(plan.notes[1].find("does not sink through 2 deg on 32 of 32 days"), std::string::npos)
      << plan.notes[1];
}

TEST(SunElevations, SitesAndDaysMultiply) {
  Scene scene = scene_at(kPrague,
                         "zone: UTC, dates: [2026-06-21, 2026-12-21], sun_elevations: "
                         "[5 deg, 60 deg]");
  scene.location =
      "locations: [{name: A, " + kPrague + "}, {name: B, latitude: -33.9, longitude: 18.4}]";
  const auto plan = plan_of(scene);
  // A knows 60 deg in June, B in December.
  ASSERT_EQ(plan.frames.size(), 12u);
  EXPECT_EQ(plan.notes.size(), 2u);
  EXPECT_EQ(plan.frames[6].site, 1);
}

TEST(SunElevations, WithoutAnyFrameTheErrorSaysWhy) {
  const auto errors = plan_errors(scene_at(kPrague, kSolstice + "sun_elevations: [80 deg]"));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].hint, "the sun passes none of these elevations on these days: choose others");
}

/// Skies picked by the sun's elevation are no film: each is metered by itself.
TEST(SunElevations, MeteredExposureDoesNotFollowFromOneToTheNext) {
  Scene both = scene_at(kPrague, kSolstice + "sun_elevations: [60 deg, 1 deg], half: morning");
  Scene one = scene_at(kPrague, kSolstice + "sun_elevations: [1 deg], half: morning");
  both.more = one.more = "exposure: {mode: metered}";
  EXPECT_EQ(plan_of(both).frames[1].ev, plan_of(one).frames[0].ev);
}

}  // namespace
