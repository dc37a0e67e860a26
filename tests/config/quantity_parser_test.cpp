#include "config/quantity_parser.h"

#include <gtest/gtest.h>

#include "core/quantity.h"

namespace skylapse::config {
namespace {

struct Row {
  std::string text;
  Dimension dimension;
  double value;
};

TEST(QuantityParser, EveryUnitHasItsFactor) {
  const double degree = (1.0 * deg).in(rad);
  const std::vector<Row> rows{
      {"235 m", Dimension::length, 235},
      {"40 km", Dimension::length, 40000},
      {"100 ft", Dimension::length, 30.48},
      {"-12.5m", Dimension::length, -12.5},
      {"2 min", Dimension::duration, 120},
      {"2 h 30 min", Dimension::duration, 9000},
      {"500 ms", Dimension::duration, 0.5},
      {"1 day", Dimension::duration, 86400},
      {"1.5 h", Dimension::duration, 5400},
      {"1h30min", Dimension::duration, 5400},
      {"7 days", Dimension::days, 7},
      {"2 weeks", Dimension::days, 14},
      {"1 deg", Dimension::angle, degree},
      {"1°", Dimension::angle, degree},
      {"30 arcmin", Dimension::angle, degree / 2},
      {"36 arcsec", Dimension::angle, degree / 100},
      {"0.5 rad", Dimension::angle, 0.5},
      {"-1 deg 30 arcmin", Dimension::angle, -1.5 * degree},
      {"1013.25 hPa", Dimension::pressure, 1013.25},
      {"101325 Pa", Dimension::pressure, 1013.25},
      {"101.325 kPa", Dimension::pressure, 1013.25},
      {"29.92 inHg", Dimension::pressure, 29.92 * 33.86389},
      {"15 degC", Dimension::temperature, 15},
      {"15 °C", Dimension::temperature, 15},
      {"288.15 K", Dimension::temperature, 15},
      {"59 degF", Dimension::temperature, 15},
      {"-40 degF", Dimension::temperature, -40},
      {"15 EV", Dimension::exposure_value, 15},
      {"-0.5", Dimension::exposure_value, -0.5},
      {"30 stops/h", Dimension::exposure_rate, 0.5},
      {"24 fps", Dimension::frame_rate, 24},
      {"29.97", Dimension::frame_rate, 29.97},
      {"1e3 m", Dimension::length, 1000},
      {"+.5 km", Dimension::length, 500},
  };
  for (const Row& row : rows) {
    const auto value = parse_quantity(row.text, row.dimension);
    ASSERT_TRUE(value.ok()) << row.text << ": " << value.error().message;
    EXPECT_NEAR(*value, row.value, 1e-12 * std::max(1.0, std::abs(row.value))) << row.text;
  }
}

TEST(QuantityParser, EveryWayToWriteALatitudeMeansTheSamePlace) {
  const double prague = (50 + 4 / 60.0 + 32 / 3600.0) * deg.factor;
  for (const char* text :
       {"50°04'32\"N", "50° 04' 32\" N", "50°04′32″N", "N 50°04'32\"", "50°4'32''",
        "50 deg 4 arcmin 32 arcsec", "+50°04'32\"", "50.0755555555555555 deg",
        "50.0755555555555555", "50°4.53333333333333'N"}) {
    const auto value = parse_quantity(text, Dimension::latitude);
    ASSERT_TRUE(value.ok()) << text << ": " << value.error().message;
    EXPECT_NEAR(*value, prague, 1e-13) << text;
  }
  for (const char* text : {"33.8568 S", "-33.8568", "-33.8568 deg", "33.8568°S", "S33.8568",
                           "\u221233.8568\u00A0deg"}) {
    const auto value = parse_quantity(text, Dimension::latitude);
    ASSERT_TRUE(value.ok()) << text << ": " << value.error().message;
    EXPECT_NEAR(*value, -33.8568 * deg.factor, 1e-15) << text;
  }
  EXPECT_NEAR(*parse_quantity("0°30'W", Dimension::longitude), -0.5 * deg.factor, 1e-15);
  EXPECT_NEAR(*parse_quantity("-0°30'", Dimension::longitude), -0.5 * deg.factor, 1e-15);
}

TEST(QuantityParser, AMissingUnitIsAnErrorThatShowsTheCorrectedValue) {
  const auto height = parse_quantity("235", Dimension::length);
  ASSERT_FALSE(height.ok());
  EXPECT_EQ(height.error().message, "235 has no unit");
  EXPECT_EQ(height.error().hint, "write 235 m; allowed units: m, km, ft");
  EXPECT_FALSE(parse_quantity("0", Dimension::angle).ok());
  EXPECT_FALSE(parse_quantity("15", Dimension::temperature).ok());
}

TEST(QuantityParser, AUnitOfAnotherKindIsNamedAsSuch) {
  const auto wrong = parse_quantity("15 hPa", Dimension::temperature);
  ASSERT_FALSE(wrong.ok());
  EXPECT_EQ(wrong.error().message, "15 hPa is a pressure, and this is a temperature");
}

TEST(QuantityParser, AMistypedUnitSuggestsTheNearest) {
  const auto wrong = parse_quantity("30 minuts", Dimension::duration);
  ASSERT_FALSE(wrong.ok());
  EXPECT_EQ(wrong.error().message, "the unit \"minuts\" is not known");
  EXPECT_EQ(wrong.error().hint, "allowed units: s, min, h, ms, day; did you mean 30 minute?");
}

TEST(QuantityParser, WhatIsNoFiniteDecimalNumberIsRefused) {
  for (const char* text :
       {"nan m",    "inf m",    "-inf m",  ".inf m",  "NaN",       "infinity km", "1e400 m",
        "-1e400 m", "1e-400 m", "0x10 m",  "m",       "",          "-",           "+",
        ".",        "- m",      "1..2 m",  "--1 m",   "1 m m",     "1 m 2",       "1 km 200 m",
        "five m",   "1,5 m",    "1'000 m", "1_000 m", "\xC2\xB2 m"})
    EXPECT_FALSE(parse_quantity(text, Dimension::length).ok()) << text;
  for (const char* text : {"nan", "inf", "1e400", "", "3 m", "0x1p3", "1,5", "-", "1 2"})
    EXPECT_FALSE(parse_number(text).ok()) << text;
  for (const char* text : {"1.0", "1e3", "", "99999999999999999999", "-", "a", "1 2", "0x10"})
    EXPECT_FALSE(parse_integer(text).ok()) << text;
}

TEST(QuantityParser, ADecimalCommaIsExplained) {
  EXPECT_EQ(parse_quantity("50,0755 deg", Dimension::latitude).error().hint,
            "decimals are written with a point");
}

TEST(QuantityParser, SumsFallInUnitAndCarryOver) {
  for (const char* text : {"30 min 2 h", "2 h 90 min", "1 h 1 h", "2 h -30 min", "2 h + 30 min"})
    EXPECT_FALSE(parse_quantity(text, Dimension::duration).ok()) << text;
  EXPECT_FALSE(parse_quantity("50°60'N", Dimension::latitude).ok());
  EXPECT_FALSE(parse_quantity("50°04'61\"N", Dimension::latitude).ok());
}

TEST(QuantityParser, HemispheresBelongToTheirAxisAndReplaceTheSign) {
  EXPECT_EQ(parse_quantity("14.4 E", Dimension::latitude).error().message,
            "east cannot be a latitude");
  EXPECT_EQ(parse_quantity("14.4 N", Dimension::longitude).error().hint, "longitudes take E or W");
  EXPECT_FALSE(parse_quantity("-33.8 S", Dimension::latitude).ok());
  EXPECT_FALSE(parse_quantity("S", Dimension::latitude).ok());
  EXPECT_FALSE(parse_quantity("N 33 S", Dimension::latitude).ok());
  EXPECT_FALSE(parse_quantity("33 N", Dimension::angle).ok());
}

}  // namespace
}  // namespace skylapse::config
