#include "core/quantity.h"

#include <gtest/gtest.h>

using namespace skylapse;

namespace {

template <class A, class B>
concept Addable = requires(A a, B b) {
  a + b;
};
template <class A, class B>
concept Comparable = requires(A a, B b) {
  a < b;
};
template <class A, class U>
concept ReadableIn = requires(A a, U u) {
  a.in(u);
};

static_assert(Addable<Angle, Angle>);
static_assert(!Addable<Angle, Length>);
static_assert(!Addable<Length, Wavelength>, "a wavelength is no distance in a scene");
static_assert(!Addable<Angle, double>, "a bare number has no unit");
static_assert(!Addable<Radiance, SpectralRadiance>);
static_assert(Comparable<Pressure, Pressure> && !Comparable<Pressure, Duration>);
static_assert(ReadableIn<Angle, decltype(deg)> && !ReadableIn<Angle, decltype(km)>);

TEST(Quantity, ReadsInTheUnitItWasBuiltWith) {
  EXPECT_DOUBLE_EQ((30.0 * deg).in(deg), 30.0);
  EXPECT_DOUBLE_EQ((2.0 * km).in(metre), 2000.0);
  EXPECT_DOUBLE_EQ((1.0 * hour).in(minute), 60.0);
}

TEST(Quantity, UnitsOfOneTurnAgree) {
  EXPECT_DOUBLE_EQ((360.0 * deg).in(rad), 2 * std::numbers::pi);
  EXPECT_DOUBLE_EQ((1.0 * deg) / (60.0 * arcmin), 1.0);
  EXPECT_DOUBLE_EQ((1.0 * arcmin) / (60.0 * arcsec), 1.0);
}

TEST(Quantity, ArithmeticKeepsTheQuantity) {
  const Length sum = 1.5 * km - 500.0 * metre;
  EXPECT_DOUBLE_EQ(sum.in(km), 1.0);
  EXPECT_DOUBLE_EQ((-sum / 4.0).in(metre), -250.0);
  EXPECT_EQ(abs(-sum), sum);
}

}  // namespace
