#include "astro/time/posix_zone.h"

#include <gtest/gtest.h>

#include "../solar_table.h"

namespace skylapse::astro::test {
namespace {

using std::chrono::floor;
using std::chrono::seconds;
using std::chrono::sys_seconds;

sys_seconds at(const std::string& text) { return floor<seconds>(utc(text).utc); }

double hours_at(const std::string& rule, const std::string& text) {
  return static_cast<double>(
             PosixZone::parse(rule).value().period_at(at(text)).utc_offset.count()) /
         3600;
}

TEST(PosixZone, SwitchesOnTheLastSundaysOfTheEuropeanRule) {
  const std::string rule = "CET-1CEST,M3.5.0,M10.5.0/3";
  EXPECT_EQ(hours_at(rule, "2050-03-27T00:59:59Z"), 1);
  EXPECT_EQ(hours_at(rule, "2050-03-27T01:00:00Z"), 2);
  EXPECT_EQ(hours_at(rule, "2050-10-30T00:59:59Z"), 2);
  EXPECT_EQ(hours_at(rule, "2050-10-30T01:00:00Z"), 1);
  const ZonePeriod summer = PosixZone::parse(rule)->period_at(at("2050-07-01T00:00Z"));
  EXPECT_EQ(summer.abbreviation, "CEST");
  EXPECT_EQ(summer.begin, at("2050-03-27T01:00Z"));
  EXPECT_EQ(summer.end, at("2050-10-30T01:00Z"));
}

TEST(PosixZone, SouthernSummerSpansTheNewYear) {
  const std::string rule = "AEST-10AEDT,M10.1.0,M4.1.0/3";
  EXPECT_EQ(hours_at(rule, "2070-01-10T01:00Z"), 11);
  EXPECT_EQ(hours_at(rule, "2069-12-31T23:59Z"), 11);
  EXPECT_EQ(hours_at(rule, "2070-07-10T01:00Z"), 10);
}

TEST(PosixZone, ReadsQuotedNamesHalfHoursAndTimesBeyondTheDay) {
  EXPECT_EQ(hours_at("<+1030>-10:30<+11>-11,M10.1.0,M4.1.0", "2050-01-01T00:00Z"), 11);
  EXPECT_EQ(hours_at("<+1030>-10:30<+11>-11,M10.1.0,M4.1.0", "2050-07-01T00:00Z"), 10.5);
  EXPECT_EQ(hours_at("IST-2IDT,M3.4.4/26,M10.5.0", "2050-03-25T00:00:00Z"), 3);  // Thursday + 26 h
  EXPECT_EQ(hours_at("IST-2IDT,M3.4.4/26,M10.5.0", "2050-03-24T23:59:59Z"), 2);
  EXPECT_EQ(hours_at("<-02>2<-01>,M3.5.0/-1,M10.5.0/0", "2050-03-27T01:00Z"), -1);
  EXPECT_EQ(hours_at("<-02>2<-01>,M3.5.0/-1,M10.5.0/0", "2050-03-27T00:59Z"), -2);
}

TEST(PosixZone, NegativeDaylightSavingOfIrelandTurnsWinterBack) {
  EXPECT_EQ(hours_at("IST-1GMT0,M10.5.0,M3.5.0/1", "2050-01-01T00:00Z"), 0);
  EXPECT_EQ(hours_at("IST-1GMT0,M10.5.0,M3.5.0/1", "2050-07-01T00:00Z"), 1);
}

TEST(PosixZone, JulianDaysSkipOrCountTheLeapDay) {
  // J60 is 1 March always; 59 is 29 February of leap years and 1 March of others.
  EXPECT_EQ(hours_at("AAA0BBB,J60/0,J300/0", "2048-02-29T12:00Z"), 0);
  EXPECT_EQ(hours_at("AAA0BBB,J60/0,J300/0", "2048-03-01T00:00Z"), 1);
  EXPECT_EQ(hours_at("AAA0BBB,59/0,300/0", "2048-02-29T12:00Z"), 1);
  EXPECT_EQ(hours_at("AAA0BBB,59/0,300/0", "2049-02-28T12:00Z"), 0);
}

TEST(PosixZone, AllYearSummerTimeHasNoGapAtNewYear) {
  for (const char* t :
       {"2050-12-31T22:59:59Z", "2050-12-31T23:00Z", "2051-01-01T04:00Z", "2050-07-01T00:00Z"})
    EXPECT_EQ(hours_at("XXX3EDT4,0/0,J365/23", t), -4) << t;
}

TEST(PosixZone, FixedOffsetsHaveOnePeriod) {
  const ZonePeriod p = PosixZone::parse("<+0545>-5:45")->period_at(at("2050-01-01T00:00Z"));
  EXPECT_EQ(p.utc_offset, seconds{20700});
  EXPECT_EQ(p.end, kFarFuture);
}

TEST(PosixZone, RefusesWhatIsNoRule) {
  for (const char* text :
       {"", "CET", "CE-1", "CET-1CEST", "CET-1CEST,M3.5.0", "CET-1CEST,M3.6.0,M10.5.0",
        "CET-1CEST,M13.5.0,M10.5.0", "CET-1CEST,M3.5.7,M10.5.0", "<CET-1", "CET-1 ", "CET-200",
        "CET-1CEST,J0,J100", "CET-1CEST,M3.5.0,M10.5.0/3x", "CET-1:5"})
    EXPECT_FALSE(PosixZone::parse(text).has_value()) << text;
}

}  // namespace
}  // namespace skylapse::astro::test
