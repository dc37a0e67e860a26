// The embedded tables are the published ones: their known sums come out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "data/cie1931.h"
#include "data/ground_albedo.h"
#include "data/hosek_wilkie_spectral_pattern.h"
#include "data/solar_spectrum.h"

namespace skylapse::data {
namespace {

TEST(DataTables, MatchingFunctionsHaveTheirPublishedSums) {
  double x = 0, y = 0, z = 0;
  for (const auto& row : kCie1931) x += row[0], y += row[1], z += row[2];
  EXPECT_NEAR(y, 106.857, 5e-4);  // published to three decimals
  // The equal-energy spectrum is white, x = y = 1/3 to the four digits of CIE 15.
  EXPECT_NEAR(x / (x + y + z), 1.0 / 3, 1e-4);
  EXPECT_NEAR(y / (x + y + z), 1.0 / 3, 1e-4);
  EXPECT_EQ(kCie1931WavelengthNm.front(), 360);
  EXPECT_EQ(kCie1931WavelengthNm.back(), 830);
}

// 133.1 klx outside the atmosphere at 1 au, as integrated from ASTM G173-03.
TEST(DataTables, SunOutsideTheAtmosphereGivesItsPublishedIlluminance) {
  double sum = 0;
  for (size_t n = 0; n < kCie1931.size(); ++n) {
    const auto at = std::find(kSolarSpectrumWavelengthNm.begin(), kSolarSpectrumWavelengthNm.end(),
                              kCie1931WavelengthNm[n]);
    ASSERT_NE(at, kSolarSpectrumWavelengthNm.end());
    sum += kCie1931[n][1] * kSolarSpectrum[at - kSolarSpectrumWavelengthNm.begin()][0];
  }
  EXPECT_NEAR(kLuminousEfficacy * sum, 133100, 100);
}

TEST(DataTables, ColumnsAreNamed) {
  EXPECT_EQ(kHosekWilkieSpectralPatternColumns[7], "I");
  EXPECT_EQ(kHosekWilkieSpectralPatternColumns[8], "H");
  EXPECT_EQ(kGroundAlbedoColumns[0], "grass");
  EXPECT_EQ(kHosekWilkieSpectralPattern[0][0][0][0][8], 0.8826913);
}

}  // namespace
}  // namespace skylapse::data
