#include "plan/frame_schedule.h"

#include "plan/plan_fixture.h"

using namespace skylapse;
using namespace skylapse::plan::testing;

namespace {

std::vector<std::string> utc_times(const plan::Plan& plan) {
  std::vector<std::string> times;
  for (const auto& frame : plan.frames) times.push_back(format_utc(frame.instant));
  return times;
}

Scene with_time(const std::string& time) {
  Scene scene;
  scene.time = "time: {" + time + "}";
  return scene;
}

TEST(Schedule, FixedStepIncludesBothEnds) {
  EXPECT_EQ(utc_times(plan_of(Scene{})),
            (std::vector<std::string>{"2026-06-21T08:00:00Z", "2026-06-21T09:00:00Z",
                                      "2026-06-21T10:00:00Z"}));
}

TEST(Schedule, FrameCountIsSpreadEvenlyOverTheSpan) {
  const auto plan =
      plan_of(with_time("zone: UTC, date: 2026-06-21, from: 00:00, to: 24:00, frames: 5"));
  EXPECT_EQ(utc_times(plan).front(), "2026-06-21T00:00:00Z");
  EXPECT_EQ(utc_times(plan)[1], "2026-06-21T06:00:00Z");
  EXPECT_EQ(utc_times(plan).back(), "2026-06-22T00:00:00Z");
}

TEST(Schedule, OneFrameStandsAtTheBeginning) {
  const auto plan =
      plan_of(with_time("zone: UTC, date: 2026-06-21, from: 06:00, to: 18:00, frames: 1"));
  EXPECT_EQ(utc_times(plan), std::vector<std::string>{"2026-06-21T06:00:00Z"});
}

TEST(Schedule, AnchorsFollowTheSunToTheSecond) {
  // Sunrise in Prague on 2024-06-20 is 02:52:25 UTC (reference events).
  const auto plan = plan_of(with_time(
      "zone: Europe/Prague, date: 2024-06-20, at: [sunrise - 45 min, sunrise, solar_noon]"));
  EXPECT_EQ(utc_times(plan),
            (std::vector<std::string>{"2024-06-20T02:07:25Z", "2024-06-20T02:52:25Z",
                                      "2024-06-20T11:03:57Z"}));
}

TEST(Schedule, EveryDegreeCrossesEachWholeDegreeTwice) {
  const auto plan = plan_of(
      with_time("zone: Europe/Prague, date: 2026-06-21, from: 00:00, to: 24:00, every: 10 deg"));
  // From -16.5 deg to 63.4 deg and back: levels -10 ... 60, each rising and sinking.
  EXPECT_EQ(plan.frames.size(), 16u);
  for (const auto& frame : plan.frames) {
    const double el = elevation(frame.sky.sun_true).in(deg);
    EXPECT_NEAR(el / 10, std::round(el / 10), 2e-6) << el;
  }
}

TEST(Schedule, ADayWithATwentyThirdHourLessHasTwentyThreeHoursOfFrames) {
  const auto plan = plan_of(
      with_time("zone: Europe/Prague, date: 2024-03-31, from: 00:00, to: 24:00, step: 1 h"));
  EXPECT_EQ(plan.frames.size(), 24u);  // 23 hours, both ends included
}

TEST(Schedule, ASkippedLocalTimeIsRefusedAtItsPlaceWithBothOffsets) {
  const auto errors = plan_errors(
      with_time("zone: Europe/Prague, date: 2024-03-31, from: 02:30, to: 05:00, step: 1 h"));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].span.line, 2);
  const std::string all = errors[0].message + errors[0].hint;
  EXPECT_NE(all.find("+01:00"), std::string::npos) << all;
  EXPECT_NE(all.find("+02:00"), std::string::npos) << all;
}

TEST(Schedule, ADayThatTheZoneSkipsIsPassedOverInsideARangeWithANote) {
  Scene scene = with_time(
      "zone: Pacific/Apia, dates: 2011-12-29 .. 2011-12-31, from: 12:00, to: 12:00, step: 1 h");
  scene.location = "location: {name: Apia, latitude: -13.8333, longitude: -171.767}";
  const auto plan = plan_of(scene);
  EXPECT_EQ(plan.frames.size(), 2u);
  ASSERT_EQ(plan.notes.size(), 1u);
  EXPECT_NE(plan.notes[0].find("2011-12-30"), std::string::npos);
}

TEST(Schedule, ADayThatTheZoneSkipsIsAnErrorByItself) {
  Scene scene =
      with_time("zone: Pacific/Apia, date: 2011-12-30, from: 12:00, to: 13:00, step: 1 h");
  scene.location = "location: {name: Apia, latitude: -13.8333, longitude: -171.767}";
  EXPECT_EQ(plan_errors(scene).size(), 1u);
}

Scene apia(const std::string& time) {
  Scene scene = with_time("zone: Pacific/Apia, " + time);
  scene.location = "location: {name: Apia, latitude: -13.8333, longitude: -171.767}";
  return scene;
}

TEST(Schedule, TheDayBeforeASkippedDayEndsWhereTheDayAfterItBegins) {
  // Samoa went from 2011-12-29 24:00-10:00 to 2011-12-31 00:00+14:00, both 10:00 UTC of the 30th.
  const auto times = utc_times(plan_of(apia("dates: 2011-12-29 .. 2011-12-31, step: 6 h")));
  ASSERT_EQ(times.size(), 10u);
  EXPECT_EQ(times.front(), "2011-12-29T10:00:00Z");
  EXPECT_EQ(times[4], "2011-12-30T10:00:00Z");
  EXPECT_EQ(times[5], "2011-12-30T10:00:00Z");
  EXPECT_EQ(times.back(), "2011-12-31T10:00:00Z");
}

TEST(Schedule, ASkippedDayByItselfSaysSoAtItsDate) {
  for (const char* time : {"date: 2011-12-30, step: 6 h", "date: 2011-12-30, at: [12:00]",
                           "at: [2011-12-30 12:00]", "at: [2011-12-30 sunrise]"}) {
    const auto errors = plan_errors(apia(time));
    ASSERT_EQ(errors.size(), 1u) << time;
    EXPECT_NE(errors[0].message.find("the zone skipped that day"), std::string::npos)
        << errors[0].message;
    EXPECT_EQ(errors[0].span.source_line.substr(size_t(errors[0].span.column) - 1, 10),
              "2011-12-30");
  }
}

TEST(Schedule, DaysWithoutOrWithTwoMidnightsHaveTheirOwnLength) {
  struct Case {
    const char *time, *first, *last;
    size_t frames;  // one an hour, both ends included
  };
  for (const Case& c : {
           // Clocks jump from 00:00 to 01:00: 23 hours.
           Case{"zone: America/Havana, date: 2026-03-08, step: 1 h", "2026-03-08T05:00:00Z",
                "2026-03-09T04:00:00Z", 24},
           // Clocks go back from 01:00 to 00:00: midnight twice, 25 hours.
           Case{"zone: America/Havana, date: 2026-11-01, step: 1 h", "2026-11-01T04:00:00Z",
                "2026-11-02T05:00:00Z", 26},
           // 24:00 of the day before is the first of the two midnights.
           Case{"zone: America/Havana, date: 2026-10-31, step: 1 h", "2026-10-31T04:00:00Z",
                "2026-11-01T04:00:00Z", 25},
           Case{"zone: Africa/Cairo, dates: 2026-04-01 .. 2026-04-30, at: [00:00]",
                "2026-03-31T22:00:00Z", "2026-04-29T21:00:00Z", 30},
           Case{"zone: America/Sao_Paulo, dates: 2018-11-01 .. 2018-11-07, at: [00:00]",
                "2018-11-01T03:00:00Z", "2018-11-07T02:00:00Z", 7},
       }) {
    const auto times = utc_times(plan_of(with_time(c.time)));
    EXPECT_EQ(times.size(), c.frames) << c.time;
    EXPECT_EQ(times.front(), c.first) << c.time;
    EXPECT_EQ(times.back(), c.last) << c.time;
  }
}

TEST(Schedule, ClockTimesInsideASkippedOrRepeatedHourStayErrors) {
  for (const char* time : {"date: 2026-03-08, at: [00:30]", "date: 2026-11-01, at: [00:30]"}) {
    const auto errors = plan_errors(with_time("zone: America/Havana, " + std::string(time)));
    ASSERT_EQ(errors.size(), 1u) << time;
    const std::string all = errors[0].message + errors[0].hint;
    EXPECT_NE(all.find("-05:00"), std::string::npos) << all;
    EXPECT_NE(all.find("-04:00"), std::string::npos) << all;
  }
}

TEST(Schedule, ASpanWithoutFramesSaysWhatToDo) {
  const auto errors = plan_errors(
      with_time("zone: Europe/Prague, date: 2026-06-21, from: 12:30, to: 12:31, every: 10 deg"));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].message.find("no frame"), std::string::npos);
  EXPECT_NE(errors[0].hint.find("smaller angle"), std::string::npos) << errors[0].hint;
}

TEST(Schedule, AMissingSunriseSaysWhereTheSunStays) {
  Scene scene = with_time(
      "zone: Arctic/Longyearbyen, date: 2026-06-21, from: sunrise, to: sunset, step: 1 h");
  scene.location = "location: {name: Longyearbyen, latitude: 78.2232, longitude: 15.6267}";
  const auto errors = plan_errors(scene);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].message.find("above that level all day"), std::string::npos)
      << errors[0].message;
  EXPECT_EQ(errors[0].span.line, 2);
}

TEST(Schedule, AnIntervalThatEndsBeforeItBeginsIsRefused) {
  const auto errors = plan_errors(
      with_time("zone: Europe/Prague, date: 2026-06-21, from: sunset, to: sunrise, step: 1 h"));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].message.find("ends"), std::string::npos);
}

TEST(Schedule, SitesDaysAndListsMultiply) {
  Scene scene =
      with_time("zone: UTC, dates: 2026-06-01 .. 2026-06-03, from: 11:00, to: 12:00, step: 30 min");
  scene.location =
      "locations: [{name: A, latitude: 0, longitude: 0}, {name: B, latitude: 10, longitude: 0}]";
  scene.more = "air: {turbidity: [2, 4, 6], ground_albedo: [0.1, 0.5]}";
  scene.outputs = "outputs: [{image: \"{site}/{date}-{turbidity}-{albedo}.####.png\"}]";
  EXPECT_EQ(plan_of(scene).frames.size(), 2u * 3 * 3 * 3 * 2);
}

TEST(Schedule, FramesOfASiteComeInOrderOfTime) {
  const auto plan =
      plan_of(with_time("zone: UTC, date: 2026-06-21, at: ['18:00', '06:00', '12:00']"));
  for (size_t i = 1; i < plan.frames.size(); ++i)
    EXPECT_LT(plan.frames[i - 1].instant, plan.frames[i].instant);
}

TEST(Schedule, ALeapSecondIsAFrameOfItsOwn) {
  const auto plan = plan_of(with_time("at: ['2016-12-31T23:59:60Z']"));
  ASSERT_EQ(plan.frames.size(), 1u);
  EXPECT_EQ(format_utc(plan.frames[0].instant), "2016-12-31T23:59:60Z");
}

TEST(Schedule, ALeapSecondThatNeverWasIsRefused) {
  auto job = config::parse_job(text_of(with_time("at: ['2020-06-30T23:59:60Z']")), "scene.yaml");
  EXPECT_TRUE(!job || !plan::make_plan(*job));
}

}  // namespace
