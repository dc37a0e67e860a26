#include "sky/atmosphere/density_profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sky/atmosphere/standard_air.h"

namespace skylapse::sky::atmosphere {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Midpoint sum over pieces that end at the profile's breaks.
double column_by_sum(const DensityProfile& profile, double top_km) {
  std::vector<double> cuts = profile.breaks_km(top_km);
  cuts.insert(cuts.begin(), 0.0);
  cuts.push_back(top_km);
  constexpr int kSteps = 20000;
  double sum = 0;
  for (size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double step = (cuts[i + 1] - cuts[i]) / kSteps;
    for (int k = 0; k < kSteps; ++k) sum += profile.at(cuts[i] + (k + 0.5) * step) * step;
  }
  return sum;
}

TEST(DensityProfile, ColumnIsTheIntegralOfTheDensity) {
  const DensityProfile cases[] = {
      exponential_profile(8.0 * km, 60.0 * km),
      exponential_profile(1.2 * km, 60.0 * km),
      tent_profile(10.0 * km, 25.0 * km, 40.0 * km),
      standard_air_profile(100.0 * km),
      {{{.bottom_km = 2, .top_km = 30, .amplitude = 0.1, .inverse_scale_height_per_km = -0.05}}},
      // Cut at 0 in the middle of its range, once and twice.
      {{{.top_km = 20, .slope_per_km = -0.1, .constant = 1}}},
      {{{.top_km = 20,
         .amplitude = 2,
         .inverse_scale_height_per_km = 0.3,
         .slope_per_km = 0.05,
         .constant = -0.7}}},
  };
  for (const DensityProfile& profile : cases)
    for (const double top : {60.0, 100.0, 15.0})
      // The midpoint sum of 20000 steps over 60 km errs by 3e-7 where the scale is 1.2 km.
      EXPECT_NEAR(profile.vertical_column_km(top), column_by_sum(profile, top),
                  1e-6 * column_by_sum(profile, top));
}

TEST(DensityProfile, ColumnOfAnExponentialIsExact) {
  EXPECT_NEAR(exponential_profile(8.0 * km, 60.0 * km).vertical_column_km(60),
              8 * (1 - std::exp(-7.5)), 1e-14);
  EXPECT_NEAR(tent_profile(10.0 * km, 25.0 * km, 40.0 * km).vertical_column_km(100), 15, 1e-13);
}

/// A sweep's finding: in the middle of a column 1500 scale heights long exp() is 0, and the whole
/// column was left out.
TEST(DensityProfile, ColumnOfThinAirIsExactThroughUnderflow) {
  const auto profile = exponential_profile(10.0 * metre, 100.0 * km);
  for (const double top : {1.0, 10.0, 30.0, 57.0, 100.0})
    EXPECT_NEAR(profile.vertical_column_km(top), 0.01, 1e-16) << top;
}

TEST(DensityProfile, IsZeroOutsideItsTermsAndNeverNegative) {
  const DensityProfile tent = tent_profile(10.0 * km, 25.0 * km, 40.0 * km);
  EXPECT_EQ(tent.at(9.999), 0);
  EXPECT_EQ(tent.at(40), 0);
  EXPECT_EQ(tent.at(-1), 0);
  EXPECT_NEAR(tent.at(25), 1, 1e-15);
  EXPECT_NEAR(tent.at(17.5), 0.5, 1e-15);
  const DensityProfile falling{{{.top_km = 20, .slope_per_km = -0.1, .constant = 1}}};
  EXPECT_EQ(falling.at(15), 0);
  EXPECT_THAT(falling.breaks_km(100), ElementsAre(testing::DoubleNear(10, 1e-12), 20));
}

TEST(DensityProfile, IsFiniteAtEveryFiniteHeight) {
  for (const DensityProfile& profile :
       {standard_air_profile(100.0 * km), tent_profile(10.0 * km, 25.0 * km, 40.0 * km),
        exponential_profile(0.01 * km, 1000.0 * km)})
    for (const double height : {-1e300, -1.0, 0.0, 1e-300, 86.0, 1e6, 1e300})
      EXPECT_TRUE(std::isfinite(profile.at(height)) && profile.at(height) >= 0) << height;
}

TEST(DensityProfile, BreaksAreWhereTheFormulaChanges) {
  EXPECT_THAT(exponential_profile(8.0 * km, 60.0 * km).breaks_km(60), IsEmpty());
  EXPECT_THAT(tent_profile(10.0 * km, 25.0 * km, 40.0 * km).breaks_km(60), ElementsAre(10, 25, 40));
  EXPECT_THAT(tent_profile(10.0 * km, 25.0 * km, 40.0 * km).breaks_km(25), ElementsAre(10));
  EXPECT_EQ(standard_air_profile(100.0 * km).breaks_km(100).size(), 7u);
}

TEST(DensityProfile, NoAirHasNoColumn) {
  EXPECT_EQ(DensityProfile{}.vertical_column_km(100), 0);
  EXPECT_EQ(DensityProfile{}.at(0), 0);
}

}  // namespace
}  // namespace skylapse::sky::atmosphere
