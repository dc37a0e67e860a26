// probe of Preetham and of the CIE general sky, as a user runs it.
#include <gtest/gtest.h>

#include "run_program.h"

using namespace skylapse::cli::testing;

namespace {

const std::string kHead =
    "turbidity,albedo,sun_elevation_deg,view_zenith_deg,relative_azimuth_deg,band,kind";

Outcome probe(const std::string& model, const std::string& csv) {
  return run({"probe", "--model", model, "--batch", "-"}, {.input = csv});
}

/// The last field of a line.
double luminance(const Outcome& outcome, size_t line) {
  std::istringstream lines(outcome.out);
  std::string text;
  for (size_t i = 0; i <= line; ++i) std::getline(lines, text);
  return std::stod(text.substr(text.rfind(',') + 1));
}

// tests/data/sky_models/directions.tsv: sun at zenith angle 30, view at 60, azimuth 90.
TEST(ProbeBaseline, PreethamIsThatOfTheTable) {
  const auto outcome = probe("preetham", kHead + "\n2.5,0.2,60,60,90,Y,xyz\n");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NEAR(luminance(outcome, 1), 7147.23, 0.006);
  EXPECT_TRUE(outcome.out.starts_with(kHead + ",radiance,luminance\n")) << outcome.out;
}

TEST(ProbeBaseline, CieIsRelativeToItsZenithAsInTheTable) {
  const auto outcome =
      probe("cie", kHead +
                       ",cie_type\n2.5,0,60,0,0,Y,xyz,12\n2.5,0,60,60,90,Y,xyz,12\n"
                       "2.5,0,60,60,90,Y,xyz,5\n2.5,0,60,0,0,Y,xyz,5\n");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NEAR(luminance(outcome, 2) / luminance(outcome, 1), 0.694733, 1e-6);
  EXPECT_DOUBLE_EQ(luminance(outcome, 3), luminance(outcome, 4));  // uniform
}

TEST(Probe, OptionsOfAnotherModelAreRefused) {
  const std::vector<std::vector<std::string>> cases{
      {"preetham", "--samples", "10"},         {"hosek-wilkie", "--seed", "2"},
      {"cie", "--atmosphere", "a.yaml"},       {"reference", "--level", "fine"},
      {"reference", "--precision", "double"},  {"single-scattering", "--level", "low"},
      {"bruneton", "--relative-error", "0.01"}};
  for (const auto& c : cases) {
    const auto outcome = run({"probe", "--model", c[0], c[1], c[2], "--batch", "-"}, {.input = ""});
    EXPECT_EQ(outcome.exit_code, 3) << c[0] << ' ' << c[1];
    EXPECT_NE(outcome.err.find(c[1] + ": has no effect on " + c[0]), std::string::npos)
        << outcome.err;
  }
}

TEST(ProbeBaseline, WhatTheyDoNotKnowIsRefused) {
  const auto spectral = probe("preetham", kHead + "\n2.5,0,60,60,90,550,spectral\n");
  EXPECT_EQ(spectral.exit_code, 3);
  EXPECT_NE(spectral.err.find("allowed: xyz, solar_direct"), std::string::npos) << spectral.err;
  const auto thick = probe("preetham", kHead + "\n12,0,60,60,90,Y,xyz\n");
  EXPECT_EQ(thick.exit_code, 3);
  EXPECT_NE(thick.err.find("allowed: 1.7 to 10"), std::string::npos) << thick.err;
  EXPECT_EQ(probe("cie", kHead + ",cie_type\n2.5,0,60,60,90,Y,xyz,2.5\n").exit_code, 3);
}

}  // namespace
