#include "config/air_conversion.h"

#include <gtest/gtest.h>

namespace skylapse::config {
namespace {

TEST(AirConversion, InversesUndoEachOther) {
  for (double turbidity = 1; turbidity <= 10; turbidity += 0.25) {
    EXPECT_NEAR(turbidity_from_aerosol_depth(aerosol_depth_from_turbidity(turbidity)), turbidity,
                1e-12);
    EXPECT_NEAR(turbidity_from_visibility(visibility_from_turbidity(turbidity)), turbidity, 1e-11);
  }
}

TEST(AirConversion, AgreesWithTheFormulasWorkedByHand) {
  // T = 3: beta = 0.04608 * 3 - 0.04586 = 0.09238; 0.55^1.3 = 0.459700; depth = 0.200957;
  // extinction = 0.200957 / 1200 m + 1.15e-5 = 1.78964e-4 per metre; 3.912 / that = 21.859 km.
  EXPECT_NEAR(aerosol_depth_from_turbidity(3), 0.200957, 2e-6);
  EXPECT_NEAR(visibility_from_turbidity(3).in(km), 21.859, 1e-3);
}

TEST(AirConversion, MoreHazeIsAlwaysHigherTurbidity) {
  for (double v = 2; v < 300; v *= 1.1)
    EXPECT_GT(turbidity_from_visibility(v * km), turbidity_from_visibility(1.1 * v * km));
  EXPECT_LT(turbidity_from_aerosol_depth(0.1), turbidity_from_aerosol_depth(0.2));
}

TEST(AirConversion, AirWithoutAerosolIsTurbidityOneWithinTheFitsRounding) {
  // Preetham's fit gives 0.04586 / 0.04608 = 0.9952 where the aerosol vanishes.
  EXPECT_NEAR(turbidity_from_aerosol_depth(0), 0.9952, 1e-4);
  EXPECT_NEAR(turbidity_from_visibility(3.912 / 1.15e-5 * metre), 0.9952, 1e-4);
}

TEST(AirConversion, VisibilityOfADescriptionIsTheSameWhereTheDescriptionIs) {
  const sky::atmosphere::AirDescription air;  // 1.2 km, 1013.25 hPa
  for (const double v : {0.2, 5.0, 40.0, 300.0})
    EXPECT_NEAR(turbidity_from_aerosol_depth(aerosol_depth_from_visibility(v * km, air)),
                turbidity_from_visibility(v * km), 1e-9);
}

TEST(AirConversion, VisibilityIsMadeOfTheExtinctionAtTheGround) {
  sky::atmosphere::AirDescription air;
  air.aerosol_scale_height = 3.0 * km;
  air.top_height = 40.0 * km;
  air.surface_pressure = 900.0 * hPa;
  for (const double v : {0.2, 2.0, 20.0, 300.0}) {
    air.aerosol_optical_depth = aerosol_depth_from_visibility(v * km, air);
    const auto atmosphere = sky::atmosphere::atmosphere_of(air);
    ASSERT_TRUE(atmosphere.ok());
    const double extinction_per_km = atmosphere->aerosol_extinction.at(550.0 * nm) +
                                     atmosphere->rayleigh_scattering.at(550.0 * nm);
    // Koschmieder's share for molecules is the rounded 1.15e-5 per metre, 0.1 % high; the
    // atmosphere holds all of its molecules below 40 km, which is 0.25 % more at the ground.
    EXPECT_NEAR(3.912 / extinction_per_km / v, 1, 3e-3) << v;
  }
}

TEST(AirConversion, BeyondTheGreatestVisibilityThereIsLessThanNoHaze) {
  sky::atmosphere::AirDescription air;
  EXPECT_NEAR(greatest_visibility(air).in(km), 340.2, 0.1);
  EXPECT_NEAR(aerosol_depth_from_visibility(greatest_visibility(air), air), 0, 1e-12);
  EXPECT_LT(aerosol_depth_from_visibility(350 * km, air), 0);
  air.surface_pressure = 0.0 * hPa;
  EXPECT_GT(aerosol_depth_from_visibility(1000 * km, air), 0);
}

}  // namespace
}  // namespace skylapse::config
