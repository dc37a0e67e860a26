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

}  // namespace
}  // namespace skylapse::config
