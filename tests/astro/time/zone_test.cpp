#include "astro/time/zone.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "../solar_table.h"

namespace skylapse::astro::test {
namespace {

using std::chrono::local_days;
using std::chrono::seconds;
using std::chrono::year;
using ::testing::HasSubstr;

Zone zone(const std::string& name) {
  Result<Zone> found = Zone::find(name);
  if (!found) throw std::runtime_error(found.error().message);
  return *std::move(found);
}

/// "2024-03-31T02:30" of a wall clock.
WallTime wall(const std::string& text) { return WallTime{utc(text + "Z").utc.time_since_epoch()}; }

std::string to_utc(const std::string& zone_name, const std::string& text) {
  const Result<Instant> t = zone(zone_name).to_instant(wall(text));
  return t ? format_utc(*t) : t.error().message;
}

CivilDay day(const std::string& zone_name, int y, unsigned m, unsigned d) {
  const Result<CivilDay> found = zone(zone_name).civil_day(year{y} / m / d);
  if (!found) throw std::runtime_error(found.error().message);
  return *found;
}

double hours(const CivilDay& d) { return (d.end - d.start).in(hour); }

TEST(Zone, ShowsTheReferenceWallClockOfEveryRow) {
  int after_2037 = 0;
  for (const TableRow& row : read_solar_table("wall_clocks.tsv")) {
    const LocalTime local = zone(row.text("zone")).to_local(row.instant("utc"));
    EXPECT_EQ(format_local(local), row.text("wall")) << row.text("zone") << " " << row.text("utc");
    after_2037 += row.text("case") == "zone_after_2037";
  }
  EXPECT_EQ(after_2037, 4);
}

TEST(Zone, LocalTimeAndInstantInvertEachOtherUnlessTheClockReadsTwice) {
  for (const TableRow& row : read_solar_table("wall_clocks.tsv")) {
    const Zone z = zone(row.text("zone"));
    const Result<Instant> back = z.to_instant(z.to_local(row.instant("utc")).wall);
    if (back)
      EXPECT_EQ(*back, row.instant("utc")) << row.text("zone") << " " << row.text("utc");
    else
      EXPECT_THAT(back.error().message, HasSubstr("twice")) << row.text("utc");
  }
}

TEST(LocalTime, SkippedBySummerTimeIsRejectedWithBothOffsets) {
  const Result<Instant> t = zone("Europe/Prague").to_instant(wall("2024-03-31T02:30:00"));
  ASSERT_FALSE(t.ok());
  EXPECT_EQ(t.error().code, ErrorCode::invalid_input);
  EXPECT_THAT(t.error().message, HasSubstr("does not exist"));
  EXPECT_THAT(t.error().message, HasSubstr("2024-03-31T02:00:00+01:00"));
  EXPECT_THAT(t.error().message, HasSubstr("2024-03-31T03:00:00+02:00"));
  EXPECT_THAT(t.error().hint, HasSubstr("+01:00"));
  EXPECT_EQ(to_utc("Europe/Prague", "2024-03-31T01:59:59"), "2024-03-31T00:59:59Z");
  EXPECT_EQ(to_utc("Europe/Prague", "2024-03-31T03:00:00"), "2024-03-31T01:00:00Z");
}

TEST(LocalTime, RepeatedBySummerTimeIsRejectedWithBothOffsets) {
  const Result<Instant> t = zone("America/Denver").to_instant(wall("2006-10-29T01:15:00"));
  ASSERT_FALSE(t.ok());
  EXPECT_THAT(t.error().message, HasSubstr("twice"));
  EXPECT_THAT(t.error().message, HasSubstr("-06:00"));
  EXPECT_THAT(t.error().message, HasSubstr("-07:00"));
  EXPECT_THAT(t.error().hint, HasSubstr("2006-10-29T01:15:00-06:00"));
  EXPECT_EQ(to_utc("America/Denver", "2006-10-29T00:59:59"), "2006-10-29T06:59:59Z");
  EXPECT_EQ(to_utc("America/Denver", "2006-10-29T02:00:00"), "2006-10-29T09:00:00Z");
}

TEST(LocalTime, IsSkippedAndRepeatedAfter2037Too) {
  EXPECT_THAT(to_utc("Europe/Prague", "2050-03-27T02:30:00"), HasSubstr("does not exist"));
  EXPECT_THAT(to_utc("Europe/Prague", "2050-10-30T02:30:00"), HasSubstr("twice"));
  EXPECT_EQ(to_utc("Europe/Prague", "2050-07-01T12:00:00"), "2050-07-01T10:00:00Z");
  EXPECT_EQ(to_utc("Australia/Sydney", "2150-01-10T12:00:00"), "2150-01-10T01:00:00Z");
}

TEST(CivilDay, LengthFollowsTheClockChanges) {
  EXPECT_EQ(hours(day("Europe/Prague", 2024, 3, 31)), 23);
  EXPECT_EQ(hours(day("Europe/Prague", 2024, 10, 27)), 25);
  EXPECT_EQ(hours(day("Europe/Prague", 2050, 3, 27)), 23);
  EXPECT_EQ(hours(day("Australia/Lord_Howe", 2024, 4, 7)), 24.5);
  EXPECT_EQ(hours(day("Australia/Lord_Howe", 2024, 10, 6)), 23.5);
  EXPECT_EQ(hours(day("UTC", 2016, 12, 31)), 24);  // civil time: the leap second is not counted
}

TEST(CivilDay, SkippedAtTheDateLineIsAnErrorThatSaysSo) {
  const Result<CivilDay> none = zone("Pacific/Apia").civil_day(year{2011} / 12 / 30);
  ASSERT_FALSE(none.ok());
  EXPECT_THAT(none.error().message, HasSubstr("2011-12-30 does not exist in Pacific/Apia"));
  EXPECT_EQ(format_utc(day("Pacific/Apia", 2011, 12, 29).end), "2011-12-30T10:00:00Z");
  EXPECT_EQ(format_utc(day("Pacific/Apia", 2011, 12, 31).start), "2011-12-30T10:00:00Z");
  EXPECT_THAT(to_utc("Pacific/Apia", "2011-12-30T12:00:00"), HasSubstr("does not exist"));
}

TEST(CivilDay, StartsAtItsFirstInstantWhereMidnightIsSkipped) {
  // Sao Paulo 2018-11-04: 00:00 -> 01:00.
  const CivilDay d = day("America/Sao_Paulo", 2018, 11, 4);
  EXPECT_EQ(format_utc(d.start), "2018-11-04T03:00:00Z");
  EXPECT_EQ(hours(d), 23);
  EXPECT_EQ(format_local(zone("America/Sao_Paulo").to_local(d.start)), "2018-11-04T01:00:00-02:00");
}

TEST(CivilDay, StartsAtTheFirstOfTwoMidnights) {
  // Havana 2023-11-05: 01:00 -> 00:00, so 00:00 comes twice.
  const CivilDay d = day("America/Havana", 2023, 11, 5);
  EXPECT_EQ(format_utc(d.start), "2023-11-05T04:00:00Z");
  EXPECT_EQ(hours(d), 25);
  // St John's 2010-11-07: 00:01 -> 23:01 of the day before; the first midnight counts.
  EXPECT_EQ(hours(day("America/St_Johns", 2010, 11, 7)), 25);
  EXPECT_EQ(hours(day("America/St_Johns", 2010, 11, 6)), 24);
}

TEST(CivilDay, DaysTileTheYearsWithoutGapInEveryKnownOddZone) {
  for (const char* name :
       {"Europe/Prague", "Pacific/Apia", "Pacific/Kwajalein", "America/Sao_Paulo", "America/Havana",
        "America/St_Johns", "Australia/Lord_Howe", "Africa/Casablanca", "Antarctica/Troll",
        "Asia/Gaza", "Asia/Kathmandu", "Pacific/Kiritimati", "America/Caracas", "Asia/Pyongyang"}) {
    const Zone z = zone(name);
    std::optional<Instant> expected;
    int skipped = 0;
    const local_days last = local_days{year{2045} / 1 / 1};
    for (local_days d = local_days{year{1990} / 1 / 1}; d < last; d += std::chrono::days{1}) {
      const Result<CivilDay> found = z.civil_day(std::chrono::year_month_day{d});
      if (!found) {
        ++skipped;
        continue;
      }
      if (expected) {
        ASSERT_EQ(found->start, *expected) << name << " " << d.time_since_epoch().count();
      }
      ASSERT_LT(found->start, found->end);
      expected = found->end;
    }
    EXPECT_LE(skipped, 1) << name;
  }
}

TEST(Zone, FixedOffsetsNeedNoTables) {
  EXPECT_EQ(to_utc("+02:00", "2026-06-21T06:30:00"), "2026-06-21T04:30:00Z");
  EXPECT_EQ(to_utc("-7", "2003-10-17T12:30:30"), "2003-10-17T19:30:30Z");
  EXPECT_EQ(to_utc("+0545", "2026-01-01T00:00:00"), "2025-12-31T18:15:00Z");
  for (const char* name : {"UTC", "Z", "+00:00"})
    EXPECT_EQ(to_utc(name, "2026-06-21T06:30:00"), "2026-06-21T06:30:00Z");
  EXPECT_FALSE(Zone::find("+19:00").ok());
  EXPECT_FALSE(Zone::find("+2:3").ok());
}

TEST(Zone, UnknownNamesCarryTheNearestKnownOne) {
  const auto hint = [](const std::string& name) {
    const Result<Zone> found = Zone::find(name);
    EXPECT_FALSE(found.ok()) << name;
    return found.ok() ? std::string() : found.error().hint;
  };
  EXPECT_THAT(hint("Europe/Prag"), HasSubstr("Europe/Prague"));
  EXPECT_THAT(hint("europe/prague"), HasSubstr("Europe/Prague"));
  EXPECT_THAT(hint("Prague"), HasSubstr("Europe/Prague"));
  EXPECT_THAT(hint("Asia/Katmandoo"), HasSubstr("Asia/Kat"));
  EXPECT_THAT(hint("Moon/Tranquility_Base_Station"), HasSubstr("IANA"));
  for (const char* name : {"", "/etc/passwd", "../../etc/passwd", "Europe", "Europe/", "zone.tab"})
    EXPECT_FALSE(Zone::find(name).ok()) << name;
}

TEST(Zone, ZonesWithoutTransitionsAndTimesBeforeTheFirstOneWork) {
  EXPECT_EQ(format_local(zone("Etc/GMT+5").to_local(utc("2026-01-01T00:00Z"))),
            "2025-12-31T19:00:00-05:00");
  EXPECT_EQ(format_local(zone("Etc/UTC").to_local(utc("2199-01-01T00:00Z"))),
            "2199-01-01T00:00:00+00:00");
  EXPECT_EQ(to_utc("Asia/Kolkata", "2199-12-31T05:30:00"), "2199-12-31T00:00:00Z");
  // Local mean time, before zones: Kathmandu's +5:41:16 until 1920.
  EXPECT_EQ(format_local(zone("Asia/Kathmandu").to_local(utc("1905-01-01T00:00Z"))),
            "1905-01-01T05:41:16+05:41:16");
}

TEST(Zone, LeapSecondKeepsItsNameOnTheWall) {
  EXPECT_EQ(format_local(zone("Asia/Kathmandu").to_local(utc("2016-12-31T23:59:60.5Z")), 1),
            "2017-01-01T05:44:60.5+05:45");
  EXPECT_EQ(format_local(zone("UTC").to_local(utc("2016-12-31T23:59:60.96Z")), 1),
            "2017-01-01T00:00:00.0+00:00");
}

}  // namespace
}  // namespace skylapse::astro::test
