#include "sky/ground_albedo.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace skylapse::sky {
namespace {

TEST(GroundAlbedo, EveryListedNameHasAPhysicalSpectrum) {
  ASSERT_GE(ground_albedo_names().size(), 10u);
  EXPECT_TRUE(std::is_sorted(ground_albedo_names().begin(), ground_albedo_names().end()));
  for (const std::string& name : ground_albedo_names()) {
    const auto albedo = albedo_bands(name);
    ASSERT_TRUE(albedo.has_value()) << name;
    for (const double value : albedo->bands) {
      EXPECT_GT(value, 0) << name;
      EXPECT_LT(value, 1) << name;
    }
  }
}

TEST(GroundAlbedo, UnknownNamesAreNothing) {
  EXPECT_FALSE(albedo_bands("gras").has_value());
  EXPECT_FALSE(albedo_bands("").has_value());
}

TEST(GroundAlbedo, GrassIsGreenAndRisesInTheNearInfrared) {
  const auto grass = albedo_bands("grass");
  ASSERT_TRUE(grass.has_value());
  EXPECT_GT(grass->bands[6], grass->bands[3]);       // 560 nm over 440 nm
  EXPECT_GT(grass->bands[6], grass->bands[8]);       // 560 nm over 640 nm
  EXPECT_GT(grass->bands[10], 2 * grass->bands[9]);  // the red edge
  EXPECT_NEAR(grass->mean, 0.049, 0.003);            // trapezoid over the table, 400..700 nm
}

TEST(GroundAlbedo, GreyIsTheSameInAllBands) {
  const AlbedoSpectrum grey = grey_bands(0.4);
  EXPECT_EQ(grey.mean, 0.4);
  for (const double value : grey.bands) EXPECT_EQ(value, 0.4);
  EXPECT_EQ(albedo_bands("sand")->bands, grey.bands);
}

}  // namespace
}  // namespace skylapse::sky
