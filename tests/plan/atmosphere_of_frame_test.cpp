// Air that changes: keyframes in time, and the few media whose tables serve all frames.
#include "plan/atmosphere_of_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "config/air_conversion.h"
#include "plan/plan_fixture.h"

using namespace skylapse;
using namespace skylapse::plan;
using namespace skylapse::plan::testing;
using sky::atmosphere::canonical_text;

namespace {

constexpr const char* kDay =
    "time: {zone: Europe/Prague, date: 2026-06-21, from: 00:00, to: 24:00, step: 1 h}";

/// A frame of the job's first site at a moment of the day.
Frame frame_at(const config::JobConfig& job, int hour, int minute = 0) {
  Frame frame;
  config::TimeExpression time;
  time.clock = std::chrono::hours(hour) + std::chrono::minutes(minute);
  using namespace std::chrono_literals;
  frame.date = std::chrono::year(2026) / 6 / 21;
  frame.instant = *resolve_time(time, frame.date, job.sites[0], *zone_of(job, job.sites[0]));
  return frame;
}

config::JobConfig job_with_air(const std::string& air, const std::string& time = kDay) {
  Scene scene;
  scene.time = time;
  scene.more = "air: " + air + "\nsky: {model: bruneton, wavelengths: 3}";
  return job_of(scene);
}

AirTimeline timeline_of(const config::JobConfig& job) {
  auto timeline = make_air_timeline(job);
  EXPECT_TRUE(timeline.ok());
  return timeline ? *timeline : AirTimeline{};
}

TEST(AirOfFrame, ConstantAirIsTheJobsWithTheFramesHazeAndGround) {
  const auto job = job_with_air("{turbidity: [2, 4], ground_albedo: [0.1, snow], ozone: 350 DU}");
  const AirTimeline timeline = timeline_of(job);
  EXPECT_TRUE(timeline.sites.empty());
  Frame frame = frame_at(job, 12);
  frame.turbidity = 1, frame.albedo = 1;
  const auto air = air_of_frame(job, timeline, frame);
  EXPECT_NEAR(air.aerosol_optical_depth, config::aerosol_depth_from_turbidity(4), 1e-12);
  EXPECT_NEAR(air.ground_albedo.at(360.0 * nm), 0.9754, 1e-12);
  EXPECT_EQ(air.ozone_du, 350);
  const auto media = tables_of_frame(job, timeline, frame);
  ASSERT_TRUE(media.ok());
  EXPECT_EQ(media->weight, 0);
  EXPECT_EQ(canonical_text(media->a), canonical_text(media->b));
  EXPECT_EQ(canonical_text(media->a), canonical_text(*medium_of_frame(job, timeline, frame)));
  EXPECT_EQ(media->a.bands.size(), 3u);
}

TEST(AirOfFrame, GoesLinearlyBetweenKeyframesAndStaysOutside) {
  const auto job = job_with_air(
      "{keyframes: [{time: 12:00, aerosol_optical_depth: 0.1, ozone: 300 DU}, "
      "{time: 06:00, aerosol_optical_depth: 0.5, ozone: 360 DU}]}");
  const AirTimeline timeline = timeline_of(job);
  const auto depth = [&](int hour, int minute = 0) {
    return air_of_frame(job, timeline, frame_at(job, hour, minute)).aerosol_optical_depth;
  };
  EXPECT_NEAR(depth(0), 0.5, 1e-12);
  EXPECT_NEAR(depth(6), 0.5, 1e-12);
  EXPECT_NEAR(depth(9), 0.3, 1e-12);
  EXPECT_NEAR(depth(10, 30), 0.2, 1e-12);
  EXPECT_NEAR(depth(12), 0.1, 1e-12);
  EXPECT_NEAR(depth(23), 0.1, 1e-12);
  EXPECT_NEAR(air_of_frame(job, timeline, frame_at(job, 9)).ozone_du, 330, 1e-12);
}

TEST(AirOfFrame, KeyframesOfOzoneLeaveAListOfHazesAlone) {
  const auto job = job_with_air(
      "{turbidity: [2, 4], keyframes: [{time: 06:00, ozone: 300 DU}, {time: 12:00, ozone: 400 "
      "DU}]}");
  const AirTimeline timeline = timeline_of(job);
  Frame frame = frame_at(job, 9);
  frame.turbidity = 1;
  const auto air = air_of_frame(job, timeline, frame);
  EXPECT_NEAR(air.aerosol_optical_depth, config::aerosol_depth_from_turbidity(4), 1e-12);
  EXPECT_NEAR(air.ozone_du, 350, 1e-9);
}

TEST(AirTimeline, KeyframesWithoutADayFallOnEveryDay) {
  const auto job =
      job_with_air("{keyframes: [{time: 06:00, ozone: 300 DU}, {time: solar_noon, ozone: 320 DU}]}",
                   "time: {zone: Europe/Prague, dates: 2026-06-20 .. 2026-06-22, at: 12:00}");
  const AirTimeline timeline = timeline_of(job);
  ASSERT_EQ(timeline.sites.size(), 1u);
  ASSERT_EQ(timeline.sites[0].size(), 6u);
  for (size_t i = 1; i < 6; ++i) EXPECT_TRUE(timeline.sites[0][i - 1].at < timeline.sites[0][i].at);
  // Through the night from the noon's 320 DU to the morning's 300: no jump at midnight.
  EXPECT_NEAR(air_of_frame(job, timeline, frame_at(job, 0)).ozone_du, 320 - 20 * 10.95 / 16.95,
              0.2);
}

TEST(AirTimeline, EventsThatDoNotHappenAndTimesGivenTwiceAreErrorsWithTheirPlace) {
  const auto twice = job_with_air("{keyframes: [{time: 06:00}, {time: 04:00Z, ozone: 310 DU}]}");
  const auto error = make_air_timeline(twice);
  ASSERT_FALSE(error.ok());
  EXPECT_NE(error.error()[0].message.find("two keyframes"), std::string::npos);
  EXPECT_GT(error.error()[0].span.line, 0);
  Scene polar;
  polar.location = "location: {latitude: 78.2, longitude: 15.6}";
  polar.more = "air: {keyframes: [{time: sunset, ozone: 310 DU}]}";
  const auto never = make_air_timeline(job_of(polar));
  ASSERT_FALSE(never.ok());
  EXPECT_NE(never.error()[0].message.find("there is no sunset"), std::string::npos);
  EXPECT_GT(never.error()[0].span.line, 0);
}

/// Vertical depths that tell two media apart: aerosol, ozone.
std::pair<double, double> depths(const sky::atmosphere::Medium& medium) {
  const double top = medium.top_height_km;
  const auto& band = medium.bands[1];
  return {band.aerosol_extinction_per_km * medium.aerosol.vertical_column_km(top),
          band.ozone_absorption_per_km * medium.ozone.vertical_column_km(top)};
}

TEST(TablesOfFrame, AreFewServeAllFramesAndBlendToTheFramesOwnAir) {
  const auto job = job_with_air(
      "{keyframes: [{time: 04:00, visibility: 2 km}, {time: 12:00, visibility: 60 km, ozone: 340 "
      "DU}, {time: 20:00, visibility: 2 km}]}");
  const AirTimeline timeline = timeline_of(job);
  std::set<std::string> media;
  const double ozone_per_du = [&] {
    auto frame = frame_at(job, 4);
    return depths(*medium_of_frame(job, timeline, frame)).second / 300;
  }();
  for (int minute = 0; minute < 24 * 60; minute += 10) {
    const Frame frame = frame_at(job, minute / 60, minute % 60);
    const auto tables = tables_of_frame(job, timeline, frame);
    ASSERT_TRUE(tables.ok());
    EXPECT_GE(tables->weight, 0);
    EXPECT_LE(tables->weight, 1);
    media.insert(canonical_text(tables->a));
    media.insert(canonical_text(tables->b));
    const auto own = depths(*medium_of_frame(job, timeline, frame));
    const auto a = depths(tables->a), b = depths(tables->b);
    const auto blend = [&](double x, double y) { return x + tables->weight * (y - x); };
    EXPECT_NEAR(blend(a.first, b.first), own.first, 1e-9);
    EXPECT_NEAR(blend(a.second, b.second), own.second, 1e-9);
    const double floor = 0.03;  // the grid's floor of 0.02 at 550 nm, in a band at shorter waves
    EXPECT_LE((std::max(a.first, b.first) + floor) / (std::min(a.first, b.first) + floor), 1.2501);
    EXPECT_LE(std::abs(a.second - b.second), 25.001 * ozone_per_du);
  }
  // From depth 2.33 to 0.064 and 40 DU: ln(2.35 / 0.084) / ln 1.25 + 40 / 25 = 16.5 steps.
  EXPECT_LE(media.size(), 19u);  // the evening uses the morning's
  EXPECT_GE(media.size(), 17u);
}

TEST(TablesOfFrame, StayThemselvesOnTheNodesAndChangeWithoutAStep) {
  const auto job = job_with_air(
      "{keyframes: [{time: 06:00, aerosol_optical_depth: 0}, {time: 18:00, aerosol_optical_depth: "
      "1}]}");
  const AirTimeline timeline = timeline_of(job);
  double previous = -1;
  for (int minute = 6 * 60; minute <= 18 * 60; ++minute) {
    const auto tables = tables_of_frame(job, timeline, frame_at(job, minute / 60, minute % 60));
    ASSERT_TRUE(tables.ok());
    const double depth =
        (1 - tables->weight) * depths(tables->a).first + tables->weight * depths(tables->b).first;
    EXPECT_GT(depth, previous) << minute;
    previous = depth;
  }
  const auto first = tables_of_frame(job, timeline, frame_at(job, 5));
  EXPECT_EQ(canonical_text(first->a), canonical_text(first->b));
  EXPECT_EQ(depths(first->a).first, 0);
}

}  // namespace
