#include "study/delta_e.h"

#include <gtest/gtest.h>

#include <array>

namespace skylapse::study {
namespace {

struct Pair {
  glm::dvec3 a, b;
  double difference;
};

/// From the supplementary data of Sharma, Wu & Dalal 2005, table 1 (pairs 1, 4, 7, 9, 13, 17, 21,
/// 25, 27, 34), which were chosen for the discontinuities of the hue; printed with 4 decimals.
constexpr std::array<Pair, 10> kPublished{
    {{{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
     {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
     {{50, 0, 0}, {50, -1, 2}, 2.3669},
     {{50, 2.49, -0.001}, {50, -2.49, 0.0009}, 7.1792},
     {{50, -0.001, 2.49}, {50, 0.0009, -2.49}, 4.8045},
     {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
     {{50, 2.5, 0}, {50, 3.1736, 0.5854}, 1.0000},
     {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
     {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
     {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082}}};

TEST(DeltaE, AgreesWithThePublishedPairs) {
  for (const Pair& p : kPublished) {
    EXPECT_NEAR(ciede2000(p.a, p.b), p.difference, 5e-5);
    EXPECT_NEAR(ciede2000(p.b, p.a), p.difference, 5e-5);
  }
}

TEST(DeltaE, IsNothingBetweenEqualColours) {
  EXPECT_EQ(ciede2000({50, 10, -20}, {50, 10, -20}), 0);
}

TEST(LabOfSrgb, WhiteIsHundredAndGreysHaveNoHue) {
  const glm::dvec3 white = lab_of_srgb({1, 1, 1}), grey = lab_of_srgb({0.5, 0.5, 0.5});
  EXPECT_NEAR(white.x, 100, 1e-9);
  EXPECT_NEAR(grey.y, 0, 1e-9);
  EXPECT_NEAR(grey.z, 0, 1e-9);
  EXPECT_NEAR(lab_of_srgb({0, 0, 0}).x, 0, 1e-12);
}

}  // namespace
}  // namespace skylapse::study
