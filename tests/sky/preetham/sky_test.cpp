#include "sky/preetham/sky.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/atmosphere_truth.h"

namespace skylapse::sky::preetham {
namespace {

// The table gives four decimals of luminance and five of chromaticity.
TEST(Preetham, ZenithIsThePapers) {
  int rows = 0;
  for (TruthRow& row : read_truth("preetham_zenith.tsv", "sky_models")) {
    const auto model = Model::make(row["turbidity"], (90 - row["sun_zenith_deg"]) * deg);
    ASSERT_TRUE(model.ok());
    EXPECT_NEAR(model->zenith().luminance, row["Y"], 6e-5);
    EXPECT_NEAR(model->zenith().x, row["x"], 6e-6);
    EXPECT_NEAR(model->zenith().y, row["y"], 6e-6);
    ++rows;
  }
  EXPECT_EQ(rows, 9);
}

TEST(Preetham, DirectionsAreThePapers) {
  int rows = 0;
  for (TruthRow& row : read_truth("directions.tsv", "sky_models")) {
    const Direction<Enu> sun = enu_direction(0 * deg, (90 - row["sun_zenith_deg"]) * deg);
    const Direction<Enu> view =
        enu_direction(row["azimuth_deg"] * deg, (90 - row["view_zenith_deg"]) * deg);
    EXPECT_NEAR(separation(view, sun).in(deg), row["chi_deg"], 6e-5);
    const auto model = Model::make(2.5, elevation(sun));
    ASSERT_TRUE(model.ok());
    const Xyy found = model->at(view.z(), separation(view, sun));
    EXPECT_NEAR(found.luminance, row["Y"], 6e-6);
    EXPECT_NEAR(found.x, row["x"], 6e-7);
    EXPECT_NEAR(found.y, row["y"], 6e-7);
    ++rows;
  }
  EXPECT_EQ(rows, 40);
}

TEST(Preetham, LuminanceIsPositiveInTheWholeDomain) {
  double least = 1e9;
  for (double turbidity = kLowestTurbidity; turbidity <= kHighestTurbidity; turbidity += 0.1)
    for (double sun = 0; sun <= 90; sun += 2.5) {
      const auto model = Model::make(turbidity, sun * deg);
      ASSERT_TRUE(model.ok());
      for (double view = 0; view <= 90; view += 2.5)
        for (double gamma = std::abs(view - 90 + sun); gamma <= 180; gamma += 5) {
          const Xyy found = model->at(std::cos(view * deg.factor), gamma * deg);
          least = std::min(least, found.luminance);
          EXPECT_GT(found.y, 0.1);
          EXPECT_LT(found.x + found.y, 0.99);
        }
    }
  EXPECT_GT(least, 0.01);  // kcd/m^2
}

TEST(Preetham, RefusesWhatItCannotDo) {
  for (const double turbidity : {1.6, 10.1, std::nan("")}) {
    const auto made = Model::make(turbidity, 40 * deg);
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().hint, "allowed: 1.7 to 10");
  }
  EXPECT_FALSE(Model::make(3, -0.01 * deg).ok());
  EXPECT_FALSE(Model::make(3, std::nan("") * deg).ok());
  EXPECT_FALSE(make_sky(3, enu_direction(0 * deg, 40 * deg), 0 * deg).ok());
}

TEST(Preetham, TheHorizonIsTheLimitOfDirectionsAboveIt) {
  const auto model = Model::make(2.5, 30 * deg);
  ASSERT_TRUE(model.ok());
  const Xyy horizon = model->at(0, 60 * deg), above = model->at(2e-3, 60 * deg);
  EXPECT_TRUE(std::isfinite(horizon.luminance));
  EXPECT_NEAR(horizon.luminance, above.luminance, 1e-6);
  EXPECT_EQ(model->at(-0.5, 60 * deg).luminance, horizon.luminance);
}

TEST(Preetham, TheBeamIsDimmedByAirAndHaze) {
  // Vertical: 0.0986 of molecules, 0.0463 * 0.55^-1.3 of aerosol at T 2, 0.03 of ozone.
  EXPECT_NEAR(-std::log(beam_transmittance(2, 550 * nm, 90 * deg)), 0.1002 + 0.1007 + 0.025, 0.01);
  for (const double turbidity : {2.0, 6.0})
    for (double up = 0; up < 90; up += 1)
      EXPECT_LT(beam_transmittance(turbidity, 450 * nm, up * deg),
                beam_transmittance(turbidity, 650 * nm, up * deg));
}

}  // namespace
}  // namespace skylapse::sky::preetham
