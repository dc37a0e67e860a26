#include "core/frames.h"

#include <gtest/gtest.h>

#include <limits>

using namespace skylapse;

namespace {

template <class A, class B>
concept Separable = requires(A a, B b) {
  separation(a, b);
};
static_assert(Separable<Direction<Enu>, Direction<Enu>>);
static_assert(!Separable<Direction<Enu>, Direction<CameraFrame>>);

TEST(EnuDirection, CompassPointsLieOnTheAxes) {
  EXPECT_NEAR(enu_direction(0 * deg, 0 * deg).y(), 1, 1e-15);
  EXPECT_NEAR(enu_direction(90 * deg, 0 * deg).x(), 1, 1e-15);
  EXPECT_NEAR(enu_direction(123 * deg, 90 * deg).z(), 1, 1e-15);
}

TEST(EnuDirection, AnglesRoundTripOverTheSphere) {
  for (double az = 0; az < 360; az += 7.5)
    for (double el = -85; el <= 85; el += 5) {
      const auto d = enu_direction(az * deg, el * deg);
      EXPECT_NEAR(azimuth(d).in(deg), az, 1e-12);
      EXPECT_NEAR(elevation(d).in(deg), el, 1e-12);
    }
}

TEST(EnuDirection, AzimuthStaysBelowAFullTurnJustWestOfNorth) {
  const auto d = Direction<Enu>::from_vector({-1e-300, 1, 0});
  EXPECT_GE(azimuth(d).in(deg), 0);
  EXPECT_LT(azimuth(d).in(deg), 360);
}

TEST(EnuDirection, ZenithHasAnAzimuthAndNoNan) {
  const auto zenith = Direction<Enu>::from_vector({0, 0, 3});
  EXPECT_EQ(azimuth(zenith).in(deg), 0);
  EXPECT_DOUBLE_EQ(elevation(zenith).in(deg), 90);
}

TEST(Separation, IsExactForTinyAndOppositeDirections) {
  const auto a = enu_direction(10 * deg, 20 * deg);
  EXPECT_NEAR(separation(a, enu_direction(10 * deg, 20 * deg + 1e-6 * arcsec)).in(arcsec), 1e-6,
              1e-10);
  EXPECT_DOUBLE_EQ(separation(a, Direction<Enu>::from_vector(-a.vec())).in(deg), 180);
}

}  // namespace
