// What is in a picture goes on from one minute to the next: the year at six places, in samples. The
// command year_walk takes every minute.
#include <gtest/gtest.h>

#include "astro/time/zone.h"
#include "stability/year_walk.h"

namespace skylapse::stability {
namespace {

class EveryPlace : public testing::TestWithParam<size_t> {};

/// A day and an hour of each of 52 weeks: every phase of the day meets every season.
TEST_P(EveryPlace, NothingJumpsFromMinuteToMinuteThroughTheYear) {
  const Place& place = places()[GetParam()];
  Steps all;
  for (int week = 0; week < 52; ++week) {
    const auto begin =
        *astro::parse_instant("2026-01-01T00:00Z") + double(week * 7 * 24 + week) * hour;
    all.add(walk(place, begin, 8 * 60));
  }
  EXPECT_TRUE(within_bounds(all)) << table(all);
}

/// The last night of 2016 had a leap second; the clock's years begin in the middle of it.
TEST_P(EveryPlace, NothingJumpsOverNewYearAndTheLeapSecond) {
  const Steps steps =
      walk(places()[GetParam()], *astro::parse_instant("2016-12-31T12:00Z"), 24 * 60);
  EXPECT_TRUE(within_bounds(steps)) << table(steps);
}

INSTANTIATE_TEST_SUITE_P(Walk, EveryPlace, testing::Range(size_t{0}, size_t{6}));

/// A wall clock that jumps moves no sun: minutes are counted in UTC, and the zone's offset changes
/// once, by an hour.
TEST(ClockChange, ChangesTheWallClockAndNotTheSky) {
  const auto zone = astro::Zone::find("Europe/Prague");
  ASSERT_TRUE(zone.ok());
  for (const char* evening : {"2026-03-28T22:00Z", "2026-10-24T22:00Z"}) {
    const auto begin = *astro::parse_instant(evening);
    const Steps steps = walk(places()[3], begin, 6 * 60);
    EXPECT_TRUE(within_bounds(steps)) << table(steps);
    int changes = 0;
    auto before = zone->to_local(begin).utc_offset;
    for (int i = 1; i <= 6 * 60; ++i) {
      const auto now = zone->to_local(begin + double(i) * minute).utc_offset;
      if (now != before) ++changes;
      before = now;
    }
    EXPECT_EQ(changes, 1) << evening;
  }
}

/// The walk must see a jump, or its silence means nothing.
TEST(Walk, SeesAJump) {
  Steps steps = walk(places()[3], *astro::parse_instant("2026-06-21T00:00Z"), 10);
  EXPECT_TRUE(within_bounds(steps)) << table(steps);
  steps.exposure.size = 1;
  EXPECT_FALSE(within_bounds(steps));
  EXPECT_GT(steps.true_sun.size, 0.1) << "a minute moves the sun";
}

}  // namespace
}  // namespace skylapse::stability
