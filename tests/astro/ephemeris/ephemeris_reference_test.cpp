// Sun and moon against the JPL ephemeris (tests/data/solar/SOURCE.md).
#include <gtest/gtest.h>

#include <cmath>

#include "../measured.h"
#include "../solar_table.h"
#include "astro/ephemeris/ephemeris.h"

namespace skylapse::astro::test {
namespace {

/// The rows' own TT - UT1 where it differs from our rule: before 1972 and the NREL example.
EphemerisOptions options_of(const TableRow& row) {
  EphemerisOptions options;
  const bool before_leap_seconds = row.text("utc") < "1972";
  if (before_leap_seconds || row.text("case") == "spa_published")
    options.tt_minus_ut1 = row.number("tt_minus_ut1_s") * second;
  return options;
}

SkyState state_of(const TableRow& row) {
  const RefractionConditions air{.enabled = true,
                                 .pressure = row.number("air_hpa") * hPa,
                                 .temperature = row.number("air_celsius") * degC};
  return Ephemeris(options_of(row)).sky_state(row.instant("utc"), row.position(), air);
}

struct Case {
  TableRow row;
  SkyState state;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> list;
    for (const TableRow& row : read_solar_table("positions.tsv"))
      list.push_back({row, state_of(row)});
    return list;
  }();
  return all;
}

template <class Error>
void expect_everywhere(const std::string& what, double limit, Error error) {
  Largest largest;
  for (const Case& c : cases()) largest.see(error(c.row, c.state), c.row.label());
  expect_within(largest, limit, what);
}

TEST(SunPosition, WithinTenthOfAnArcsecOfEveryReferenceRow) {
  ASSERT_EQ(cases().size(), 426u);
  // epv00 differs from DE441 by 0.0143" at most; the rest is rounding of the table (4e-4").
  expect_everywhere("sun direction, arcsec", 0.1, [](const TableRow& r, const SkyState& s) {
    return separation(s.sun_true, enu_direction(r.angle("sun_azimuth"), r.angle("sun_elevation")))
        .in(arcsec);
  });
}

TEST(SunPosition, RefractedElevationWithinHalfAnArcsec) {
  int compared = 0;
  // The true elevation's error, and 0.11" at the zenith where we keep refraction from going
  // negative.
  expect_everywhere("refracted elevation, arcsec", 0.5, [&](const TableRow& r, const SkyState& s) {
    if (!r.has("sun_elevation_refracted")) return 0.0;
    ++compared;
    return abs(elevation(s.sun_apparent) - r.angle("sun_elevation_refracted")).in(arcsec);
  });
  EXPECT_GT(compared, 200);
}

TEST(SunPosition, RefractionKeepsTheAzimuth) {
  expect_everywhere("azimuth change x cos(elevation), arcsec", 1e-6,
                    [](const TableRow&, const SkyState& s) {
                      const double cross =
                          s.sun_true.x() * s.sun_apparent.y() - s.sun_true.y() * s.sun_apparent.x();
                      return std::abs(cross) * (1.0 * rad).in(arcsec);
                    });
}

TEST(SunPosition, DistanceRadiusAndDeclinationMatchTheReference) {
  // epv00: 2e-7 au at worst (ERFA's header, 4.6 km RMS, 13.4 km max heliocentric), plus 1e-7 of the
  // table.
  expect_everywhere("sun distance, au", 3e-7, [](const TableRow& r, const SkyState& s) {
    return std::abs(s.sun_distance.in(astronomical_unit)-r.number("sun_au"));
  });
  expect_everywhere("sun radius, arcsec", 4e-4, [](const TableRow& r, const SkyState& s) {
    return std::abs(s.sun_radius.in(arcsec)-959.63 / r.number("sun_au"));
  });
  expect_everywhere("sun declination, arcsec", 0.1, [](const TableRow& r, const SkyState& s) {
    return abs(s.sun_declination - r.angle("sun_declination")).in(arcsec);
  });
}

TEST(MoonPosition, WithinTwentyArcsecOfEveryReferenceRow) {
  // moon98's own worst case is 18.3" (ERFA's header).
  expect_everywhere("moon direction, arcsec", 20, [](const TableRow& r, const SkyState& s) {
    return separation(s.moon_true,
                      enu_direction(r.angle("moon_azimuth"), r.angle("moon_elevation")))
        .in(arcsec);
  });
}

TEST(MoonPosition, DistanceRadiusAndPhaseMatchTheReference) {
  // moon98's own worst case is 31.7 km; 32 km of 360,000 km change the radius by 0.09".
  expect_everywhere("moon distance, km", 32, [](const TableRow& r, const SkyState& s) {
    return std::abs(s.moon_distance.in(km)-r.number("moon_km"));
  });
  expect_everywhere("moon radius, arcsec", 0.09, [](const TableRow& r, const SkyState& s) {
    return abs(s.moon_radius - r.angle("moon_radius")).in(arcsec);
  });
  // The direction's 18.3" (the sun's direction from the moon adds 1/400 of it) and the table's
  // rounding and light-time convention, 1".
  expect_everywhere("moon phase angle, arcsec", 20, [](const TableRow& r, const SkyState& s) {
    return abs(s.moon_phase_angle - r.angle("moon_phase_angle")).in(arcsec);
  });
  // d(fraction) = sin(i) / 2 * 20" = 4.8e-5, plus 7e-5 of the table.
  expect_everywhere("lit fraction", 1.2e-4, [](const TableRow& r, const SkyState& s) {
    return std::abs(s.moon_illuminated_fraction - r.number("moon_lit"));
  });
}

}  // namespace
}  // namespace skylapse::astro::test
