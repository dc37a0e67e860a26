#include "color/rgb_space.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace skylapse::color {
namespace {

constexpr std::array kAll{RgbSpace::rec709, RgbSpace::rec2020, RgbSpace::acescg,
                          RgbSpace::aces2065_1};

/// Greatest difference of two matrices, `rows` written as standards print them.
double difference(const glm::dmat3& m, const std::array<double, 9>& rows) {
  double worst = 0;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      worst = std::max(worst, std::abs(m[c][r] - rows[static_cast<size_t>(3 * r + c)]));
  return worst;
}

TEST(RgbSpace, NamesReadBack) {
  for (const RgbSpace space : kAll) {
    const auto found = rgb_space_from_name(std::string(rgb_space_name(space)));
    ASSERT_TRUE(found.ok());
    EXPECT_EQ(*found, space);
  }
}

TEST(RgbSpace, UnknownNameListsTheKnownOnesAndTheNearest) {
  const auto found = rgb_space_from_name("rec907");
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().code, ErrorCode::invalid_input);
  EXPECT_THAT(found.error().message, testing::HasSubstr("rec907"));
  EXPECT_THAT(found.error().hint, testing::HasSubstr("aces2065-1"));
  EXPECT_THAT(found.error().hint, testing::HasSubstr("did you mean rec709?"));
}

// IEC 61966-2-1:1999 prints the sRGB matrix with four decimals: half a unit of the last.
TEST(RgbSpace, Rec709MatchesTheMatrixOfIec61966) {
  EXPECT_LT(difference(rgb_to_xyz(RgbSpace::rec709),
                       {0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505}),
            6e-5);
}

// SMPTE ST 2065-1:2012, 4.1.2: AP0 to XYZ with its own white; ten decimals printed.
TEST(RgbSpace, Ap0WithoutAdaptationMatchesSt2065) {
  EXPECT_LT(difference(native_rgb_to_xyz(rgb_primaries(RgbSpace::aces2065_1)),
                       {0.9525523959, 0.0000000000, 0.0000936786, 0.3439664498, 0.7281660966,
                        -0.0721325464, 0.0000000000, 0.0000000000, 1.0088251844}),
            5e-10);
}

// Academy TB-2014-012 annex: AP1 to AP0, ten decimals.
TEST(RgbSpace, Ap1ToAp0MatchesTheAcademy) {
  EXPECT_LT(difference(rgb_to_rgb(RgbSpace::acescg, RgbSpace::aces2065_1),
                       {0.6954522414, 0.1406786965, 0.1638690622, 0.0447945634, 0.8596711185,
                        0.0955343182, -0.0055258826, 0.0040252103, 1.0015006723}),
            5e-10);
}

// ITU-R BT.2087-0 (2015), annex 2: Rec. 709 to Rec. 2020, four decimals.
TEST(RgbSpace, Rec709ToRec2020MatchesBt2087) {
  EXPECT_LT(difference(rgb_to_rgb(RgbSpace::rec709, RgbSpace::rec2020),
                       {0.6274, 0.3293, 0.0433, 0.0691, 0.9195, 0.0114, 0.0164, 0.0880, 0.8956}),
            6e-5);
}

TEST(RgbSpace, D65OfUnitLuminanceIsWhiteInEverySpace) {
  for (const RgbSpace space : kAll) {
    const glm::dvec3 rgb = to_rgb(xyz_of(kD65White), space).value;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(rgb[c], 1.0, 1e-14) << rgb_space_name(space);
  }
}

TEST(RgbSpace, ThereAndBackIsTheSameColour) {
  const glm::dvec3 colour(0.3, 0.7, 1.9);
  for (const RgbSpace space : kAll) {
    const glm::dvec3 back = to_xyz(to_rgb({colour}, space), space).value;
    EXPECT_LT(glm::length(back - colour), 1e-14) << rgb_space_name(space);
  }
}

TEST(RgbSpace, PrimariesHaveTheirChromaticity) {
  for (const RgbSpace space : {RgbSpace::rec709, RgbSpace::rec2020}) {
    const Chromaticity green = chromaticity(to_xyz({{0, 1, 0}}, space));
    EXPECT_NEAR(green.x, rgb_primaries(space).green.x, 1e-14);
    EXPECT_NEAR(green.y, rgb_primaries(space).green.y, 1e-14);
  }
}

TEST(RgbSpace, ExrChromaticitiesAreRedGreenBlueWhite) {
  EXPECT_THAT(exr_chromaticities(RgbSpace::rec709),
              testing::ElementsAre(0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f));
}

TEST(Chromaticity, UniformCoordinatesOfD65) {
  // CIE 15:2004, table 11.1: u' = 0.1978, v' = 0.4683 for the 2-degree observer.
  const UniformChromaticity d65 = uniform_chromaticity(xyz_of(kD65White));
  EXPECT_NEAR(d65.u, 0.1978, 5e-5);
  EXPECT_NEAR(d65.v, 0.4683, 5e-5);
}

// Chromaticities of the Planckian locus and of D65 as CIE 15 tabulates them; the formula's authors
// give 1.74 % as its greatest error on the locus.
TEST(CorrelatedColourTemperature, WithinTwoPercentOfKnownWhites) {
  struct Known {
    Chromaticity xy;
    double kelvin;
  };
  for (const Known& k :
       {Known{kD65White, 6504}, Known{{0.3451, 0.3516}, 5000}, Known{{0.28063, 0.28828}, 10000},
        Known{{0.4369, 0.4041}, 3000}, Known{{0.25251, 0.25222}, 25000}})
    EXPECT_NEAR(correlated_colour_temperature_k(k.xy), k.kelvin, 0.02 * k.kelvin);
}

}  // namespace
}  // namespace skylapse::color
