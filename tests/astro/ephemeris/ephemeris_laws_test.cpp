// What must hold for every observer, whatever the numbers are.
#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "../measured.h"
#include "../solar_table.h"
#include "astro/ephemeris/apparent_place.h"
#include "astro/ephemeris/ephemeris.h"

namespace skylapse::astro::test {
namespace {

const std::vector<GeodeticPosition>& places() {
  static const std::vector<GeodeticPosition> all = [] {
    std::vector<GeodeticPosition> list;
    const double at[][3] = {{90, 0, 0},          {-90, 0, 2835},        {90, 137, 0},
                            {89.999, 12, 0},     {-89.999, -77, 0},     {0, 0, 0},
                            {0, 180, 0},         {0, -180, 0},          {23.43, 30, 0},
                            {-23.43, 120, 0},    {-0.18, -78.5, 2850},  {50.0755, 14.4378, 235},
                            {-33.87, 151.2, 0},  {78.22, 15.63, 10},    {-77.84, 166.7, 10},
                            {64.1, -21.9, 0},    {27.99, 86.9, 8849},   {31.5, 35.5, -430},
                            {66.56, 179.999, 0}, {-66.56, -179.999, 0}, {21.3, 557.9 - 360 * 2, 0},
                            {45, 405, 0}};
    for (const auto& p : at) list.push_back({p[0] * deg, p[1] * deg, p[2] * metre});
    return list;
  }();
  return all;
}

std::string where(const GeodeticPosition& p, const Instant& t) {
  return format_utc(t) + " at " + std::to_string(p.latitude.in(deg)) + " " +
         std::to_string(p.longitude.in(deg));
}

/// The sky turns by 15.04" a second; refraction changes the rate by less than a third.
constexpr double kFastestStepArcsec = 15.1;
constexpr double kFastestApparentStepArcsec = 20;

void expect_continuous_days(SunAlgorithm algorithm) {
  ASSERT_GE(places().size(), 20u);
  const Ephemeris ephemeris({.algorithm = algorithm});
  Largest truly, apparent;
  // An equinox, a solstice, and the day around New Year.
  const char* starts[] = {"2024-03-20T00:00Z", "2026-06-21T00:00Z", "2025-12-31T12:00Z"};
  for (size_t i = 0; i < places().size(); ++i) {
    const GeodeticPosition& p = places()[i];
    const Instant start = utc(starts[i % 3]);
    const std::string name = where(p, start);
    SkyState before = ephemeris.sun_state(start, p, {});
    for (int s = 1; s <= 86400; ++s) {
      const Instant t{.utc = start.utc + std::chrono::seconds{s}};
      const SkyState now = ephemeris.sun_state(t, p, {});
      truly.see(separation(before.sun_true, now.sun_true).in(arcsec), name);
      apparent.see(separation(before.sun_apparent, now.sun_apparent).in(arcsec), name);
      before = now;
    }
  }
  expect_within(truly, kFastestStepArcsec, name_of(algorithm) + " true step in 1 s, arcsec");
  expect_within(apparent, kFastestApparentStepArcsec,
                name_of(algorithm) + " apparent step in 1 s, arcsec");
}

TEST(SunDirection, MovesWithoutAJumpThroughWholeDaysAtEveryPlace) {
  expect_continuous_days(SunAlgorithm::erfa);
}
TEST(SunDirection, OfSg2MovesWithoutAJumpToo) { expect_continuous_days(SunAlgorithm::sg2); }

TEST(MoonDirection, MovesWithoutAJumpThroughADayAtEveryPlace) {
  const Ephemeris ephemeris;
  Largest step;
  for (const GeodeticPosition& p : places()) {
    const Instant start = utc("2026-06-21T00:00Z");
    SkyState before = ephemeris.sky_state(start, p, {});
    for (int s = 10; s <= 86400; s += 10) {
      const SkyState now = ephemeris.sky_state(start + s * second, p, {});
      step.see(separation(before.moon_apparent, now.moon_apparent).in(arcsec),
               where(p, start + s * second));
      before = now;
    }
  }
  expect_within(step, 10 * kFastestApparentStepArcsec, "moon step in 10 s, arcsec");
}

TEST(SunDirection, CrossesTheLeapSecondWithoutAJump) {
  // UT1 = UTC holds the sky still for that second; TT goes on.
  const Ephemeris ephemeris;
  for (const GeodeticPosition& p : places()) {
    const auto at = [&](const char* text) {
      return ephemeris.sun_state(utc(text), p, {}).sun_true;
    };
    const auto before = at("2016-12-31T23:59:59Z"), leap = at("2016-12-31T23:59:60Z");
    const auto after = at("2017-01-01T00:00:00Z");
    EXPECT_LT(separation(before, leap).in(arcsec), kFastestStepArcsec);
    EXPECT_LT(separation(leap, after).in(arcsec), 0.1);  // the sun's own motion in 1 s: 0.04"
  }
}

bool all_finite(const SkyState& s) {
  const auto finite = [](const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  return finite(s.sun_true.vec()) && finite(s.sun_apparent.vec()) && finite(s.moon_true.vec()) &&
         finite(s.moon_apparent.vec()) && isfinite(s.sun_distance) && isfinite(s.sun_radius) &&
         isfinite(s.sun_declination) && isfinite(s.moon_distance) && isfinite(s.moon_radius) &&
         isfinite(s.moon_phase_angle) && std::isfinite(s.moon_illuminated_fraction) &&
         isfinite(azimuth(s.sun_true)) && isfinite(elevation(s.sun_apparent));
}

TEST(SkyState, IsFiniteAtEveryAwkwardTimeAndPlace) {
  const char* times[] = {
      "1900-01-01T00:00Z", "1971-12-31T23:59:59.999999Z", "1972-01-01T00:00Z",
      "2000-01-01T12:00Z", "2016-12-31T23:59:60Z",        "2016-12-31T23:59:60.999999Z",
      "2017-01-01T00:00Z", "2024-02-29T23:59:59Z",        "2023-12-31T23:59:59.999999Z",
      "2024-03-31T01:00Z", "2038-01-19T03:14:08Z",        "2199-12-31T23:59:59Z"};
  for (const SunAlgorithm a : {SunAlgorithm::erfa, SunAlgorithm::sg2, SunAlgorithm::preetham_atan2,
                               SunAlgorithm::preetham}) {
    const Ephemeris ephemeris({.algorithm = a});
    for (const char* t : times)
      for (const GeodeticPosition& p : places())
        EXPECT_TRUE(all_finite(ephemeris.sky_state(utc(t), p, {})))
            << name_of(a) << " " << where(p, utc(t));
  }
}

TEST(SkyState, IsFiniteWithTheSunInTheVeryZenith) {
  // Walk the observer under the sun until the horizontal part vanishes in rounding.
  const Ephemeris ephemeris;
  const Instant t = utc("2026-03-25T12:06Z");
  GeodeticPosition p{1.8 * deg, 0.0 * deg, 0.0 * metre};
  for (int i = 0; i < 20; ++i) {
    const SkyState s = ephemeris.sky_state(t, p, {});
    ASSERT_TRUE(all_finite(s));
    p.latitude += s.sun_true.y() * rad;
    p.longitude += s.sun_true.x() * rad;
  }
  const SkyState overhead = ephemeris.sky_state(t, p, {});
  EXPECT_NEAR(overhead.sun_true.z(), 1, 1e-15);
  EXPECT_LT(separation(overhead.sun_true, overhead.sun_apparent).in(arcsec), 1e-6);
}

TEST(SkyState, SunPartEqualsSunStateExactly) {
  for (const SunAlgorithm a : {SunAlgorithm::erfa, SunAlgorithm::sg2, SunAlgorithm::preetham}) {
    const Ephemeris first({.algorithm = a}), second_one({.algorithm = a});
    for (const GeodeticPosition& p : places()) {
      const SkyState whole = first.sky_state(utc("2026-06-21T04:31:17Z"), p, {});
      const SkyState sun = second_one.sun_state(utc("2026-06-21T04:31:17Z"), p, {});
      EXPECT_EQ(whole.sun_true.vec(), sun.sun_true.vec());
      EXPECT_EQ(whole.sun_apparent.vec(), sun.sun_apparent.vec());
      EXPECT_EQ(whole.sun_distance, sun.sun_distance);
      EXPECT_EQ(whole.sun_radius, sun.sun_radius);
      EXPECT_EQ(whole.sun_declination, sun.sun_declination);
    }
  }
}

TEST(Ephemeris, AnswersDoNotDependOnTheOrderOfCallsAndPlaces) {
  struct Question {
    Instant t;
    GeodeticPosition p;
  };
  std::vector<Question> questions;
  for (int i = 0; i < 400; ++i)
    questions.push_back({utc("2026-01-01T00:00Z") + i * 7.3 * hour, places()[i % places().size()]});
  std::vector<glm::dvec3> expected;
  for (const Question& q : questions)  // a fresh object each: no earlier calls at all
    expected.push_back(Ephemeris().sky_state(q.t, q.p, {}).moon_true.vec());
  std::vector<size_t> order(questions.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937_64(3));
  const Ephemeris shared;
  for (const size_t i : order)
    EXPECT_EQ(shared.sky_state(questions[i].t, questions[i].p, {}).moon_true.vec(), expected[i]);
}

TEST(Ephemeris, LongitudePlusAndMinus180GiveEqualAnswers) {
  for (const SunAlgorithm a : {SunAlgorithm::erfa, SunAlgorithm::sg2, SunAlgorithm::preetham_atan2,
                               SunAlgorithm::preetham}) {
    const Ephemeris ephemeris({.algorithm = a});
    for (int i = 0; i < 100; ++i) {
      const Instant t = utc("2026-01-01T00:00Z") + i * 3.7 * 24.0 * hour;
      const double lat = -90 + 1.8 * i;
      const auto at = [&](double lon) {
        return ephemeris.sky_state(t, {lat * deg, lon * deg, 0.0 * metre}, {});
      };
      const double limit = a == SunAlgorithm::erfa ? 0 : 1e-9;
      EXPECT_LE(separation(at(180).sun_true, at(-180).sun_true).in(arcsec), limit) << name_of(a);
      EXPECT_LE(separation(at(180).moon_true, at(-180).moon_true).in(arcsec), 0) << name_of(a);
    }
  }
}

TEST(Ephemeris, AzimuthAndElevationAgreeWithGeographicLibsLocalFrames) {
  // The same Earth-fixed place of the sun, a point at its distance, seen through LocalCartesian.
  Largest largest;
  const Ephemeris ephemeris;
  for (const GeodeticPosition& p : places())
    for (int i = 0; i < 50; ++i) {
      const Instant t = utc("2026-01-01T00:00Z") + i * 175.3 * hour;
      const AstronomicalTime time = astronomical_time(t, {}, {});
      CelestialNodes nodes;
      const EnuFrame frame = enu_frame(p);
      const ApparentPlace sun = sun_place(sky_frames(time, nodes.at(time.tt_days), frame));
      const glm::dvec3 point = frame.origin_m + 1.496e11 * sun.earth_fixed_direction;
      double lat = 0, lon = 0, h = 0;
      glm::dvec3 enu;
      GeographicLib::Geocentric::WGS84().Reverse(point.x, point.y, point.z, lat, lon, h);
      GeographicLib::LocalCartesian(p.latitude.in(deg), p.longitude.in(deg), p.height.in(metre))
          .Forward(lat, lon, h, enu.x, enu.y, enu.z);
      const Direction<Enu> ours = ephemeris.sun_state(t, p, {}).sun_true;
      const auto theirs = Direction<Enu>::from_vector(enu);
      const Angle azimuth_difference = atan2_angle(ours.x() * theirs.y() - ours.y() * theirs.x(),
                                                   ours.x() * theirs.x() + ours.y() * theirs.y());
      largest.see(abs(azimuth_difference).in(arcsec)*cos(elevation(ours)), where(p, t));
      largest.see(abs(elevation(ours) - elevation(theirs)).in(arcsec), where(p, t));
    }
  expect_within(largest, 1e-6, "azimuth x cos(elevation) and elevation, arcsec");
}

TEST(Ephemeris, MorningMirrorsAfternoonAboutNoonAtTheSolstice) {
  // Near the solstice the declination hardly moves (0.3" in 2 hours), so equal times before and
  // after the meridian passage give equal elevations and opposite azimuths.
  const Ephemeris ephemeris;
  for (const double lat : {-66.0, -33.0, 0.0, 10.0, 50.0, 70.0}) {
    const GeodeticPosition p{lat * deg, 0.0 * deg, 0.0 * metre};
    Instant noon = utc("2026-06-21T12:02Z");
    for (int i = 0; i < 5; ++i) {  // Newton on the east component
      const auto east = [&](Instant t) { return ephemeris.sun_state(t, p, {}).sun_true.x(); };
      const double slope = (east(noon + 1.0 * second) - east(noon + -1.0 * second)) / 2;
      noon = noon + -east(noon) / slope * second;
    }
    for (int m = 1; m <= 60; ++m) {
      const auto am = ephemeris.sun_state(noon + m * -1.0 * minute, p, {}).sun_true;
      const auto pm = ephemeris.sun_state(noon + m * 1.0 * minute, p, {}).sun_true;
      const auto mirrored = Direction<Enu>::from_vector({-pm.x(), pm.y(), pm.z()});
      EXPECT_LT(separation(am, mirrored).in(arcsec), 1.5) << lat << " " << m;
    }
  }
}

TEST(Ephemeris, Dut1TurnsTheSkyByFifteenArcsecASecond) {
  const GeodeticPosition p{0.0 * deg, 0.0 * deg, 0.0 * metre};
  const Instant t = utc("2026-03-20T09:00Z");
  const auto plain = Ephemeris().sun_state(t, p, {}).sun_true;
  const auto shifted = Ephemeris({.dut1 = 0.9 * second}).sun_state(t, p, {}).sun_true;
  EXPECT_NEAR(separation(plain, shifted).in(arcsec), 13.54, 0.01);
}

TEST(Ephemeris, AlgorithmNamesGoBothWays) {
  for (const char* name : {"erfa", "sg2", "preetham-atan2", "preetham"})
    EXPECT_EQ(name_of(sun_algorithm_from_name(name).value()), name);
  EXPECT_EQ(sun_algorithm_from_name("libnova"), std::nullopt);
}

}  // namespace
}  // namespace skylapse::astro::test
