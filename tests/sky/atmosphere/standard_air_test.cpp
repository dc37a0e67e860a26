#include "sky/atmosphere/standard_air.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace skylapse::sky::atmosphere {
namespace {

/// U.S. Standard Atmosphere, 1976, Table I: geometric height, number density per cubic metre.
struct Row {
  double height_km, per_m3;
};
constexpr std::array kTable{
    Row{0, 2.547e25},  Row{10, 8.598e24}, Row{20, 1.849e24}, Row{30, 3.828e23}, Row{40, 8.308e22},
    Row{50, 2.135e22}, Row{60, 6.439e21}, Row{70, 1.722e21}, Row{80, 3.838e20}, Row{86, 1.447e20},
    Row{90, 7.116e19}, Row{95, 2.920e19}, Row{100, 1.189e19}};

/// The standard's own equations up to 86 km (its Eqs. (18), (23), (33a), (33b)), without the mean
/// molecular weight's fall by 0.04 % above 80 km.
double standard_density(double height_km) {
  struct Layer {
    double base_km, temperature_k, lapse_k_per_km;
  };
  constexpr std::array kLayers{Layer{0, 288.15, -6.5}, Layer{11, 216.65, 0},
                               Layer{20, 216.65, 1},   Layer{32, 228.65, 2.8},
                               Layer{47, 270.65, 0},   Layer{51, 270.65, -2.8},
                               Layer{71, 214.65, -2.0}};
  constexpr double kEarthKm = 6356.766, kGravityTerm = 34.1631947;  // g0 M0 / R* in K/km
  const double h = kEarthKm * height_km / (kEarthKm + height_km);
  double pressure = 1;
  for (size_t i = 0; i < kLayers.size(); ++i) {
    const Layer& layer = kLayers[i];
    const bool last = i + 1 == kLayers.size() || h < kLayers[i + 1].base_km;
    const double rise = (last ? h : kLayers[i + 1].base_km) - layer.base_km;
    const double t = layer.temperature_k + layer.lapse_k_per_km * rise;
    pressure *= layer.lapse_k_per_km == 0
                    ? std::exp(-kGravityTerm * rise / t)
                    : std::pow(layer.temperature_k / t, kGravityTerm / layer.lapse_k_per_km);
    if (last) return pressure * 288.15 / t;
  }
  return 0;
}

TEST(StandardAir, AgreesWithThePublishedTable) {
  const DensityProfile air = standard_air_profile(120.0 * km);
  for (const Row& row : kTable)  // printed to four digits
    EXPECT_NEAR(air.at(row.height_km) / (row.per_m3 / 2.547e25), 1,
                (row.height_km <= 86 ? 1.4e-3 : 4e-3) + 4e-4)
        << row.height_km;
}

TEST(StandardAir, FollowsTheStandardsEquationsTo86KmWithin014Percent) {
  const DensityProfile air = standard_air_profile(100.0 * km);
  double worst = 0;
  for (double h = 0; h < 86; h += 0.05)
    worst = std::max(worst, std::abs(air.at(h) / standard_density(h) - 1));
  EXPECT_LT(worst, 1.4e-3 + 4e-4);  // the last: molecular weight left out above
  EXPECT_GT(worst, 1e-4);
}

TEST(StandardAir, HasNoSteps) {
  const DensityProfile air = standard_air_profile(150.0 * km);
  for (const double joint : air.breaks_km(150))
    EXPECT_NEAR(air.at(joint - 1e-9) / air.at(joint + 1e-9), 1, 1e-6) << joint;
}

TEST(StandardAir, AlwaysFallsWithHeight) {
  const DensityProfile air = standard_air_profile(200.0 * km);
  for (double h = 0.1; h < 200; h += 0.1) EXPECT_LT(air.at(h), air.at(h - 0.1)) << h;
}

TEST(StandardAir, EndsAtItsTop) {
  for (const double top : {5.0, 11.019, 60.0, 86.0, 100.0, 140.0}) {
    const DensityProfile air = standard_air_profile(top * km);
    EXPECT_GT(air.at(top - 1e-6), 0) << top;
    EXPECT_EQ(air.at(top), 0) << top;
    EXPECT_LE(air.terms.size(), size_t{kMaxDensityTerms});
  }
}

}  // namespace
}  // namespace skylapse::sky::atmosphere
