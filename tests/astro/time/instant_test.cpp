#include "astro/time/instant.h"

#include <gtest/gtest.h>

#include "../solar_table.h"

namespace skylapse::astro::test {
namespace {

std::string round_trip(const std::string& text, int decimals = 0) {
  return format_utc(utc(text), decimals);
}

TEST(Instant, ReadsIsoTimesWithZOrOffset) {
  EXPECT_EQ(round_trip("2026-06-21T04:30Z"), "2026-06-21T04:30:00Z");
  EXPECT_EQ(round_trip("2026-06-21t04:30:15z"), "2026-06-21T04:30:15Z");
  EXPECT_EQ(round_trip("2026-06-21 04:30:15.25+02:00", 3), "2026-06-21T02:30:15.250Z");
  EXPECT_EQ(round_trip("2026-01-01T00:00:00+14:00"), "2025-12-31T10:00:00Z");
  EXPECT_EQ(round_trip("2024-02-29T12:00-0330"), "2024-02-29T15:30:00Z");
  EXPECT_EQ(round_trip("1900-01-01T00:00Z"), "1900-01-01T00:00:00Z");
  EXPECT_EQ(round_trip("2199-12-31T23:59:59,9Z", 1), "2199-12-31T23:59:59.9Z");
}

TEST(Instant, RefusesWhatIsNoTimeAndSaysWhy) {
  const auto message = [](const std::string& text) {
    const Result<Instant> parsed = parse_instant(text);
    EXPECT_FALSE(parsed.ok()) << text;
    return parsed.ok() ? std::string() : parsed.error().message;
  };
  EXPECT_NE(message("2026-06-21T04:30").find("zone"), std::string::npos);
  EXPECT_NE(message("2023-02-29T04:30Z").find("calendar"), std::string::npos);
  EXPECT_NE(message("1899-12-31T23:59Z").find("1900..2199"), std::string::npos);
  EXPECT_NE(message("2200-01-01T00:00Z").find("1900..2199"), std::string::npos);
  EXPECT_NE(message("2026-06-21").find("time of day"), std::string::npos);
  for (const char* text :
       {"", "Z", "yesterday", "2026-6-21T04:30Z", "2026-06-21T4:30Z", "2026-06-21T24:00Z",
        "2026-06-21T04:60Z", "2026-06-21T04:30:61Z", "2026-06-21T04:30:15.Z", "2026-13-01T00:00Z",
        "2026-06-21T04:30Zulu", "2026-06-21T04:30+2:0", "2026-06-21T04:30+25:00",
        "99999-06-21T04:30Z", "-2026-06-21T04:30Z", "2026-06-21T04:30 Z", "2026-06-21T04:30Z "})
    EXPECT_FALSE(message(text).empty()) << text;
}

TEST(Instant, ErrorsQuoteTheTextAndShowTheForm) {
  const Result<Instant> parsed = parse_instant("noon");
  ASSERT_FALSE(parsed.ok());
  EXPECT_EQ(parsed.error().code, ErrorCode::invalid_input);
  EXPECT_NE(parsed.error().message.find("\"noon\""), std::string::npos);
  EXPECT_NE(parsed.error().hint.find("2026-06-21T04:30:00Z"), std::string::npos);
}

TEST(LeapSecond, IsReadKeptAndWritten) {
  const Instant leap = utc("2016-12-31T23:59:60Z");
  EXPECT_TRUE(leap.leap_second);
  EXPECT_EQ(leap.utc, utc("2017-01-01T00:00:00Z").utc);
  EXPECT_EQ(format_utc(leap), "2016-12-31T23:59:60Z");
  EXPECT_EQ(round_trip("2016-12-31T23:59:60.5Z", 3), "2016-12-31T23:59:60.500Z");
  EXPECT_EQ(round_trip("2017-01-01T05:29:60+05:30"), "2016-12-31T23:59:60Z");
  EXPECT_EQ(round_trip("2016-12-31T18:59:60.25-05:00", 2), "2016-12-31T23:59:60.25Z");
}

TEST(LeapSecond, IsRefusedWhereThereWasNone) {
  for (const char* text :
       {"2017-12-31T23:59:60Z", "2016-12-31T22:59:60Z", "2016-12-31T23:59:60+01:00",
        "1965-12-31T23:59:60Z", "2026-06-21T04:30:60Z", "2035-12-31T23:59:60Z"})
    EXPECT_FALSE(parse_instant(text).ok()) << text;
}

TEST(LeapSecond, StandsBetweenItsNeighbours) {
  const Instant before = utc("2016-12-31T23:59:59.999999Z");
  const Instant leap = utc("2016-12-31T23:59:60.9Z");
  const Instant after = utc("2017-01-01T00:00:00Z");
  EXPECT_LT(before, leap);
  EXPECT_LT(utc("2016-12-31T23:59:60.1Z"), leap);
  EXPECT_LT(leap, after);
  EXPECT_NE(utc("2016-12-31T23:59:60Z"), after);
}

TEST(Instant, RoundsToTheDecimalsAskedFor) {
  EXPECT_EQ(round_trip("2026-06-21T04:30:59.9996Z", 3), "2026-06-21T04:31:00.000Z");
  EXPECT_EQ(round_trip("2026-06-21T04:30:59.4996Z"), "2026-06-21T04:30:59Z");
  EXPECT_EQ(round_trip("1950-06-21T04:30:59.25Z", 1), "1950-06-21T04:30:59.3Z");
  EXPECT_EQ(round_trip("1969-12-31T23:59:59.999999Z"), "1970-01-01T00:00:00Z");
  EXPECT_EQ(round_trip("2016-12-31T23:59:60.9996Z", 3), "2017-01-01T00:00:00.000Z");
  EXPECT_EQ(round_trip("2016-12-31T23:59:59.9996Z", 3), "2016-12-31T23:59:60.000Z");
  EXPECT_EQ(round_trip("2026-06-21T04:30:00.123456Z", 6), "2026-06-21T04:30:00.123456Z");
}

TEST(Instant, ArithmeticFollowsCivilTime) {
  const Instant day = utc("2016-12-31T12:00Z");
  EXPECT_EQ(day + 24.0 * hour, utc("2017-01-01T12:00Z"));
  EXPECT_EQ((utc("2017-01-01T12:00Z") - day).in(hour), 24);
  const Instant leap = utc("2016-12-31T23:59:60.5Z");
  EXPECT_EQ(leap + Duration{}, leap);
  EXPECT_EQ(leap + 1.0 * second, utc("2017-01-01T00:00:01.5Z"));
}

}  // namespace
}  // namespace skylapse::astro::test
