#include "astro/time/time_scales.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../measured.h"
#include "../solar_table.h"

namespace skylapse::astro::test {
namespace {

TEST(TimeScales, LeapSecondsAreThoseOfTheReferenceFrom1972On) {
  int compared = 0;
  for (const TableRow& row : read_solar_table("positions.tsv")) {
    if (row.text("utc") < "1972" || row.text("case") == "spa_published") continue;
    ++compared;
    EXPECT_NEAR(tt_minus_utc(row.instant("utc")).in(second), row.number("tt_minus_ut1_s"), 1e-9)
        << row.label();
  }
  EXPECT_GT(compared, 400);
}

TEST(TimeScales, DeltaTBefore1972AgreesWithTheSwissEphemerisToAThirdOfASecond) {
  // Two models of the same observations; 0.3 s moves the moon by 0.16", the sun by 0.013".
  Largest largest;
  for (const TableRow& row : read_solar_table("positions.tsv"))
    if (row.text("utc") < "1972")
      largest.see(
          std::abs(tt_minus_utc(row.instant("utc")).in(second)-row.number("tt_minus_ut1_s")),
          row.label());
  EXPECT_FALSE(largest.where.empty());
  expect_within(largest, 0.3, "Delta T, s");
}

TEST(TimeScales, DeltaTJoinsItsPiecesAndTheLeapSeconds) {
  // The published polynomials meet within 0.2 s; at 1972 they hand over to 42.184 s.
  for (const char* year : {"1900", "1920", "1941", "1961"}) {
    const Instant joint = utc(std::string(year) + "-01-01T00:00Z");
    EXPECT_NEAR(delta_t(joint + -3.0 * hour * 24.0).in(second),
                delta_t(joint + 3.0 * hour * 24.0).in(second), 0.2)
        << year;
  }
  EXPECT_NEAR(tt_minus_utc(utc("1971-12-31T23:59:59Z")).in(second),
              tt_minus_utc(utc("1972-01-01T00:00:00Z")).in(second), 0.1);
}

TEST(TimeScales, LeapSecondsEndTheRightDays) {
  const auto ends = [](int y, unsigned m, unsigned d) {
    return day_ends_with_leap_second(std::chrono::sys_days{std::chrono::year{y} / m / d});
  };
  EXPECT_TRUE(ends(1972, 6, 30));
  EXPECT_TRUE(ends(2015, 6, 30));
  EXPECT_TRUE(ends(2016, 12, 31));
  EXPECT_FALSE(ends(1971, 12, 31));
  EXPECT_FALSE(ends(2016, 12, 30));
  EXPECT_FALSE(ends(2100, 12, 31));
}

TEST(TimeScales, TtRunsOnThroughTheLeapSecondWhileUt1Repeats) {
  const auto at = [](const char* text) { return astronomical_time(utc(text), {}, {}); };
  const auto before = at("2016-12-31T23:59:59Z");
  const auto leap = at("2016-12-31T23:59:60Z");
  const auto after = at("2017-01-01T00:00:00Z");
  EXPECT_NEAR((leap.tt_days - before.tt_days) * 86400, 1, 1e-5);
  EXPECT_NEAR((after.tt_days - leap.tt_days) * 86400, 1, 1e-5);
  EXPECT_EQ(leap.ut1_whole_days, after.ut1_whole_days);
  EXPECT_EQ(leap.ut1_day_fraction, after.ut1_day_fraction);
}

TEST(TimeScales, OptionsShiftTheClocksAsTheySay) {
  const Instant t = utc("2020-01-01T00:00Z");
  const auto plain = astronomical_time(t, {}, {});
  const auto shifted = astronomical_time(t, 0.5 * second, {});
  EXPECT_EQ(shifted.tt_days, plain.tt_days);
  EXPECT_NEAR((shifted.ut1_day_fraction - plain.ut1_day_fraction) * 86400, 0.5, 1e-9);
  const auto overridden = astronomical_time(t, 0.5 * second, 70.0 * second);
  EXPECT_NEAR((overridden.tt_days - plain.tt_days) * 86400, 70.5 - 69.184, 1e-5);
  // Before 1972 the stamp is UT1 already.
  const Instant old = utc("1965-01-01T00:00Z");
  EXPECT_EQ(astronomical_time(old, 0.5 * second, {}).ut1_day_fraction,
            astronomical_time(old, {}, {}).ut1_day_fraction);
}

}  // namespace
}  // namespace skylapse::astro::test
