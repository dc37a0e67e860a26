#include "plan/sun_for_sky.h"

#include <gtest/gtest.h>

#include <cmath>

#include "astro/ephemeris/ephemeris.h"
#include "astro/refraction.h"

using namespace skylapse;

namespace {

constexpr Illuminance kSkyAtHorizon = 2400 * lux;

astro::SkyState sky_at(Angle true_elevation, const astro::RefractionConditions& air) {
  astro::SkyState sky;
  sky.sun_true = enu_direction(200 * deg, true_elevation);
  sky.sun_apparent =
      enu_direction(200 * deg, true_elevation + astro::refraction(true_elevation, air));
  sky.sun_distance = 1 * astronomical_unit;
  sky.sun_radius = 0.2666 * deg;
  return sky;
}

TEST(SunForSky, LevelIsContinuousAndFallsAsTheSunSinks) {
  for (const bool refracted : {true, false}) {
    const astro::RefractionConditions air{.enabled = refracted};
    double last = 1;
    for (double el = 2; el > -20; el -= 0.01) {
      const auto sun = plan::sun_for_sky(sky_at(el * deg, air), air, kSkyAtHorizon);
      EXPECT_LE(sun.twilight_level, last * (1 + 1e-12)) << el;
      EXPECT_GT(sun.twilight_level, last * 0.98) << "a step at " << el;
      last = sun.twilight_level;
    }
  }
}

TEST(SunForSky, IsExtrapolatedExactlyWhenTheApparentCentreIsBelowTheHorizon) {
  const astro::RefractionConditions air;
  const Angle horizon = plan::true_elevation_of_apparent_horizon(air);
  EXPECT_NEAR(horizon.in(arcmin), -34.5, 0.6);  // Bennett 1982: 34.5 arcmin on the horizon
  EXPECT_FALSE(
      plan::sun_for_sky(sky_at(horizon + 0.1 * arcsec, air), air, kSkyAtHorizon).extrapolated);
  EXPECT_TRUE(
      plan::sun_for_sky(sky_at(horizon - 0.1 * arcsec, air), air, kSkyAtHorizon).extrapolated);
}

TEST(SunForSky, AsksTheModelOnlyInsideItsDomain) {
  const astro::RefractionConditions air;
  for (double el = -90; el <= 90; el += 0.5) {
    const auto sun = plan::sun_for_sky(sky_at(el * deg, air), air, kSkyAtHorizon);
    EXPECT_GE(sun.elevation.in(deg), 0);
    EXPECT_LE(sun.elevation.in(deg), 90);
    EXPECT_TRUE(std::isfinite(sun.twilight_level));
    EXPECT_GE(elevation(sun.direction).in(deg), -1e-9);
  }
}

TEST(SunForSky, SunlightFallsWithTheSquareOfTheDistance) {
  auto sky = sky_at(30 * deg, {});
  sky.sun_distance = 1.0167 * astronomical_unit;  // early July
  EXPECT_NEAR(plan::sun_for_sky(sky, {}, kSkyAtHorizon).distance_factor, 0.967, 0.001);
}

}  // namespace
