#include "color/cie_observer.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

namespace skylapse::color {
namespace {

std::vector<Wavelength> every(double first, double last, double step) {
  std::vector<Wavelength> nodes;
  for (double w = first; w <= last + 1e-9; w += step) nodes.push_back(w * nm);
  return nodes;
}

// CIE 1931 at 1 nm: the sum of ybar is 106.857 (CIE 15:2004 gives 106.86).
TEST(CieObserver, FlatSpectrumHasTheSumOfTheTable) {
  const auto weights = xyz_weights(every(400, 700, 100));
  glm::dvec3 sum(0.0);
  for (const auto& w : weights) sum += w;
  EXPECT_NEAR(sum.y, 106.857, 5e-4);
  EXPECT_NEAR(sum.x, 106.865, 5e-3);
  EXPECT_NEAR(sum.z, 106.892, 5e-3);
}

TEST(CieObserver, IlluminantD65HasItsChromaticity) {
  std::ifstream file(std::string(SKYLAPSE_TEST_DATA) + "/color/d65_relative_power.csv");
  std::string line;
  std::getline(file, line);
  std::vector<Wavelength> nodes;
  std::vector<double> values;
  double wavelength_nm = 0;
  double power = 0;
  while (std::getline(file, line))
    if (std::sscanf(line.c_str(), "%lf,%lf", &wavelength_nm, &power) == 2) {
      nodes.push_back(wavelength_nm * nm);
      values.push_back(power);
    }
  ASSERT_EQ(nodes.size(), 97u);
  // Four decimals printed; the table's end at 780 nm and its 5 nm steps add 2e-5.
  const Chromaticity xy = chromaticity(xyz_of_spectrum(nodes, values));
  EXPECT_NEAR(xy.x, 0.3127, 7e-5);
  EXPECT_NEAR(xy.y, 0.3290, 7e-5);
}

TEST(CieObserver, NodesOfALineAddNothingNew) {
  // A spectrum that is straight between coarse nodes has the same XYZ on fine nodes.
  const auto coarse = every(360, 830, 47);
  const auto fine = every(360, 830, 1);
  std::vector<double> on_coarse;
  for (const Wavelength w : coarse) on_coarse.push_back(std::sin(w.in(nm) / 90.0) + 2.0);
  std::vector<double> on_fine;
  for (const Wavelength w : fine) {
    const double at = (w.in(nm)-360.0) / 47.0;
    const auto i = std::min<size_t>(static_cast<size_t>(at), coarse.size() - 2);
    const double t = at - static_cast<double>(i);
    on_fine.push_back((1 - t) * on_coarse[i] + t * on_coarse[i + 1]);
  }
  const glm::dvec3 a = xyz_of_spectrum(coarse, on_coarse).value;
  const glm::dvec3 b = xyz_of_spectrum(fine, on_fine).value;
  EXPECT_LT(glm::length(a - b), 1e-12 * glm::length(a));
}

TEST(CieObserver, EndsAreHeldNotCutOff) {
  const std::vector<Wavelength> nodes{500.0 * nm, 600.0 * nm};
  const auto weights = xyz_weights(nodes);
  const auto one = xyz_weights(std::vector<Wavelength>{550.0 * nm});
  EXPECT_LT(glm::length(weights[0] + weights[1] - one[0]), 1e-10);
}

}  // namespace
}  // namespace skylapse::color
