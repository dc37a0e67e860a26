#include "config/time_expression.h"

#include <gtest/gtest.h>

namespace skylapse::config {
namespace {

using namespace std::chrono_literals;
using astro::EventKind;
using std::chrono::year_month_day;

const year_month_day kSolstice = std::chrono::year(2026) / 6 / 21;

TimeExpression parsed(const std::string& text) {
  auto time = parse_time_expression(text);
  EXPECT_TRUE(time.ok()) << text << ": " << (time.ok() ? "" : time.error().message);
  return time.ok() ? *time : TimeExpression{};
}

std::string problem(const std::string& text) {
  const auto time = parse_time_expression(text);
  return time.ok() ? "no problem" : time.error().message + " | " + time.error().hint;
}

TEST(TimeExpression, AnchorsTakeAnOffsetOfEitherSign) {
  const TimeExpression early = parsed("sunrise - 45 min");
  EXPECT_EQ(early.anchor, EventKind::sunrise);
  EXPECT_EQ(early.offset.in(minute), -45);
  EXPECT_FALSE(early.date || early.clock || early.utc_offset);
  EXPECT_EQ(parsed("civil_dusk + 10 min").offset.in(minute), 10);
  EXPECT_EQ(parsed("civil_dusk+10min").offset.in(minute), 10);
  EXPECT_EQ(parsed("sunset - 1 h 30 min").offset.in(minute), -90);
  EXPECT_EQ(parsed("sunset - 4500 ms").offset.in(second), -4.5);
  EXPECT_EQ(parsed("solar_noon").offset.in(second), 0);
}

TEST(TimeExpression, EveryEventOfTheSkyIsAnAnchor) {
  ASSERT_EQ(anchor_names().size(), size_t(astro::kEventKindCount));
  for (const std::string& name : anchor_names()) {
    const TimeExpression time = parsed(name);
    ASSERT_TRUE(time.anchor.has_value());
    EXPECT_EQ(astro::name_of(*time.anchor), name);
  }
}

TEST(TimeExpression, DatesJoinByABlankOrAT) {
  for (const char* text : {"2026-06-21 sunrise - 45 min", "2026-06-21Tsunrise-45 min"}) {
    const TimeExpression time = parsed(text);
    EXPECT_EQ(time.date, kSolstice);
    EXPECT_EQ(time.anchor, EventKind::sunrise);
    EXPECT_EQ(time.offset.in(minute), -45);
  }
}

TEST(TimeExpression, ClocksRunFromMidnightToMidnight) {
  EXPECT_EQ(parsed("04:30").clock, 4h + 30min);
  EXPECT_EQ(parsed("4:30").clock, 4h + 30min);
  EXPECT_EQ(parsed("00:00").clock, 0h);
  EXPECT_EQ(parsed("24:00").clock, 24h);
  EXPECT_EQ(parsed("23:59:59.25").clock, 23h + 59min + 59s + 250ms);
  EXPECT_EQ(parsed("04:30 + 10 min").offset.in(minute), 10);
  EXPECT_EQ(parsed("24:00 + 4 h").offset.in(hour), 4);
  for (const char* text : {"24:01", "25:00", "12:60", "12:00:61", "12", "12:0", "12:000", "1200"})
    EXPECT_FALSE(parse_time_expression(text).ok()) << text;
}

TEST(TimeExpression, OffsetsFromUtcAreToldFromDurationsByTheirLackOfAUnit) {
  struct Row {
    const char* text;
    std::chrono::seconds utc_offset;
    double shift_min;
  };
  for (const Row& row : {Row{"2026-06-21T04:30+02:00", 2h, 0}, Row{"2026-06-21T04:30Z", 0s, 0},
                         Row{"2026-06-21 04:30 UTC", 0s, 0}, Row{"04:30-07:00", -7h, 0},
                         Row{"04:30 +05:45", 5h + 45min, 0}, Row{"04:30+0530", 5h + 30min, 0},
                         Row{"04:30+2", 2h, 0}, Row{"04:30 -2 + 10 min", -2h, 10},
                         Row{"04:30+02:00 - 10 min", 2h, -10}, Row{"04:30Z-1 h", 0s, -60}}) {
    const TimeExpression time = parsed(row.text);
    EXPECT_EQ(time.clock, 4h + 30min) << row.text;
    EXPECT_EQ(time.utc_offset, row.utc_offset) << row.text;
    EXPECT_EQ(time.offset.in(minute), row.shift_min) << row.text;
  }
  EXPECT_FALSE(parsed("04:30-45 min").utc_offset.has_value());
  EXPECT_FALSE(parse_time_expression("04:30+25:00").ok());
  EXPECT_FALSE(parse_time_expression("04:30+02:60").ok());
  EXPECT_FALSE(parse_time_expression("04:30+02:").ok());
  EXPECT_FALSE(parse_time_expression("sunrise+02:00").ok());
}

TEST(TimeExpression, TheLeapSecondKeepsItsOwnReading) {
  const TimeExpression leap = parsed("2016-12-31T23:59:60Z");
  EXPECT_TRUE(leap.leap_second);
  EXPECT_EQ(leap.clock, 24h);
  EXPECT_TRUE(parsed("2017-01-01T00:59:60+01:00").leap_second);
  EXPECT_TRUE(parsed("23:59:60.5").leap_second);
  EXPECT_FALSE(parse_time_expression("2026-06-21T23:59:60Z").ok());
}

TEST(TimeExpression, DaysThatDoNotExistAreRefused) {
  EXPECT_EQ(problem("2026-02-29 12:00"), "2026-02 has no day 29 | its last day is 28");
  EXPECT_EQ(problem("2026-13-01 12:00"),
            "there is no month 13 in \"2026-13-01\" | dates are written year-month-day");
  EXPECT_EQ(problem("1776-07-04 12:00"), "the year 1776 is out of range | allowed: 1900 to 2199");
  EXPECT_TRUE(parse_time_expression("2024-02-29 12:00").ok());
}

TEST(TimeExpression, WordsThatPeopleTryLeadToTheRightOnes) {
  EXPECT_EQ(problem("sunrize"), "\"sunrize\" is not a time | did you mean sunrise?");
  EXPECT_EQ(problem("noon"), "\"noon\" is not a time | write solar_noon, or 12:00 by the clock");
  EXPECT_EQ(problem("dusk - 5 min"),
            "\"dusk\" is not a time | write civil_dusk, nautical_dusk or astro_dusk");
  EXPECT_EQ(problem("2026-06-21"),
            "\"2026-06-21\" has no time of day | add one: 2026-06-21 00:00, or 2026-06-21 sunrise");
  EXPECT_EQ(problem("sunrise - 45"),
            "45 has no unit | write 45 s; allowed units: s, min, h, ms, day");
  EXPECT_EQ(problem("sunrise 45 min"),
            "\"45 min\" follows the time | add or take away a duration by + or -, such as "
            "sunrise - 45 min");
  for (const char* text : {"", " ", "-", "sunrise -", "sunrise - - 5 min", "sunrise - 1e400 s",
                           "sunrise + 1e9 day", "12:00 PM", "now"})
    EXPECT_FALSE(parse_time_expression(text).ok()) << text;
}

TEST(DateRange, DaysAndRangesIncludeBothEnds) {
  const auto day = parse_date_range("2026-06-21");
  ASSERT_TRUE(day.ok());
  EXPECT_EQ(day->first, kSolstice);
  EXPECT_EQ(day->last, kSolstice);
  for (const char* text : {"2026-06-01 .. 2026-06-30", "2026-06-01..2026-06-30"}) {
    const auto range = parse_date_range(text);
    ASSERT_TRUE(range.ok()) << text;
    EXPECT_EQ(range->last, std::chrono::year(2026) / 6 / 30);
    EXPECT_EQ(range->step_days, 1);
  }
  for (const char* text : {"2026-06-30 .. 2026-06-01", "2026-06-01 ..", ".. 2026-06-01",
                           "21.6.2026", "2026-6", "26-06-21", "2026-06-21x", "2026/06/21"})
    EXPECT_FALSE(parse_date_range(text).ok()) << text;
}

}  // namespace
}  // namespace skylapse::config
