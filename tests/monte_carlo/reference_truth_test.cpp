// Against numbers that were computed without this program.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "media.h"
#include "sky/monte_carlo/reference.h"
#include "support/atmosphere_truth.h"

namespace skylapse::sky::monte_carlo {
namespace {
using atmosphere::reference_medium;

/// Deviations in units of their standard error: their rms is 1 for a right answer.
struct Deviations {
  double squares = 0, worst = 0;
  int count = 0;
  void add(double value, double truth, double error) {
    const double z = (value - truth) / error;
    squares += z * z;
    worst = std::max(worst, std::abs(z));
    ++count;
  }
  [[nodiscard]] double rms() const { return std::sqrt(squares / count); }
};

constexpr std::array kSuffix{"680", "550", "440"};

// The three bands of a direction share their paths: 300 values are worth some 100 independent
// ones, so a right answer has an rms of 1 +- 0.07 and 4.5 is beyond all of them.
TEST(Reference, FirstOrderAgreesWithExactSingleScattering) {
  Deviations deviations;
  // What the table rounds, and the Gauss error of the shells.
  constexpr double kOwnError = 1e-5;
  for (TruthRow& row : read_truth("single_scattering.tsv")) {
    const ReferenceAnswer answer =
        reference_answer(reference_medium(),
                         {row["height_m"] * metre, row["sun_zenith_deg"] * deg,
                          row["view_zenith_deg"] * deg, row["azimuth_deg"] * deg},
                         {.samples = 2000, .max_order = 1});
    for (size_t b = 0; b < 3; ++b) {
      const double truth = row[std::string("radiance_") + kSuffix[b]];
      if (truth == 0) {
        EXPECT_EQ(answer.order1[b], 0);
        continue;
      }
      deviations.add(answer.order1[b], truth,
                     std::hypot(answer.order1_error[b], kOwnError * truth));
      EXPECT_LT(answer.order1_error[b], 0.1 * truth) << "not a test: too few paths";
    }
  }
  EXPECT_GT(deviations.count, 800);
  EXPECT_LT(deviations.rms(), 1.2);
  EXPECT_LT(deviations.worst, 4.5);
}

TEST(Reference, AllOrdersAgreeWithAnIndependentMonteCarlo) {
  Deviations all, four, one;
  std::map<std::tuple<double, double, double>, ReferenceAnswer> answers;
  for (TruthRow& row : read_truth("multiple_scattering.tsv")) {
    const auto key = std::tuple(row["sun_zenith_deg"], row["view_zenith_deg"], row["azimuth_deg"]);
    if (!answers.contains(key))
      answers[key] = reference_answer(
          reference_medium(), {1 * metre, get<0>(key) * deg, get<1>(key) * deg, get<2>(key) * deg},
          {.samples = 20000});
    const ReferenceAnswer& answer = answers[key];
    const size_t b = row["wavelength_nm"] == 680 ? 0 : row["wavelength_nm"] == 550 ? 1 : 2;
    all.add(answer.radiance[b], row["all"], std::hypot(answer.standard_error[b], row["all_error"]));
    four.add(answer.up_to_order4[b], row["up_to_order4"],
             std::hypot(answer.up_to_order4_error[b], row["up_to_order4_error"]));
  }
  // 30 values of 10 directions: rms 1 +- 0.22.
  EXPECT_EQ(all.count, 30);
  EXPECT_LT(all.rms(), 1.5);
  EXPECT_LT(all.worst, 3.5);
  EXPECT_LT(four.rms(), 1.5);
  EXPECT_LT(four.worst, 3.5);
}

TEST(Reference, TransmittancesAgreeWithQuadrature) {
  for (TruthRow& row : read_truth("view_transmittance.tsv")) {
    const ReferenceAnswer answer =
        reference_answer(reference_medium(),
                         {row["height_m"] * metre, 60 * deg, row["view_zenith_deg"] * deg, 0 * deg},
                         {.samples = 1, .max_order = 1});
    for (size_t b = 0; b < 3; ++b) {
      const double truth = row[std::string("transmittance_") + kSuffix[b]];
      if (truth == 0) continue;  // the table asks for space, the answer ends at the ground
      // exp(-tau) passes an error of the columns on times tau; the depths reach some 12.
      EXPECT_NEAR(answer.transmittance[b], truth, 2e-5 * truth) << row["view_zenith_deg"];
    }
  }
  for (TruthRow& row : read_truth("sun_transmittance.tsv")) {
    const ReferenceAnswer answer =
        reference_answer(reference_medium(),
                         {row["height_m"] * metre, row["sun_zenith_deg"] * deg, 0 * deg, 0 * deg},
                         {.samples = 1, .max_order = 1});
    for (size_t b = 0; b < 3; ++b) {
      const double truth = row[std::string("transmittance_") + kSuffix[b]];
      EXPECT_NEAR(answer.sun_transmittance[b], truth, 2e-5 * truth) << row["sun_zenith_deg"];
    }
  }
}

TEST(Reference, RayleighSlabAgreesWithAddingDoubling) {
  Deviations deviations;
  for (TruthRow& row : read_truth("slab_rayleigh.tsv")) {
    const Angle sun = std::acos(row["mu0"]) * rad, view = std::acos(row["mu"]) * rad;
    for (const auto& [azimuth, name] :
         {std::pair{0.0, "radiance_000"}, {90.0, "radiance_090"}, {180.0, "radiance_180"}}) {
      if (row["mu"] == 1 && azimuth > 0) continue;  // the zenith has no azimuth
      const ReferenceAnswer answer = reference_answer(
          slab(row["tau"], 0), {0 * metre, sun, view, azimuth * deg}, {.samples = 2000, .seed = 5});
      // Six decimals in the table; 40 nodes leave some 1e-4 of the value.
      deviations.add(answer.radiance[0], row[name],
                     std::hypot(answer.standard_error[0], 1e-6, 2e-4 * row[name]));
    }
  }
  // 84 values, independent: rms 1 +- 0.08.
  EXPECT_EQ(deviations.count, 84);
  EXPECT_LT(deviations.rms(), 1.25);
  EXPECT_LT(deviations.worst, 4);
}

// The whole table: bench_validation. Thick clouds have rare bright paths, which take more of them.
TEST(Reference, CloudPassesTheFluxOfAddingDoubling) {
  for (TruthRow& row : read_truth("slab_cloud.tsv"))
    for (const auto& [mu0, name] : {std::pair{1.0, "mu0_1.0"}, {0.5, "mu0_0.5"}}) {
      if (row["tau"] > 2) continue;
      const ReferenceIrradiance flux = reference_irradiance(
          cloud(row["tau"]), 0 * metre, std::acos(mu0) * rad,
          {.samples = 8000, .seed = 8, .aerosol = AerosolShape::henyey_greenstein});
      // Four decimals in the table.
      EXPECT_NEAR((flux.sun[0] + flux.sky[0]) / mu0, row[name],
                  4 * std::hypot(flux.sky_error[0] / mu0, 5e-5))
          << row["tau"] << ' ' << mu0;
      EXPECT_LT(flux.sky_error[0], 0.06 * mu0) << "not a test: " << row["tau"] << ' ' << mu0;
    }
}

// Guided draws at each of hundreds of events once made weights so uneven that this came out as 0.
TEST(Reference, ThickCloudsKeepTheirLight) {
  const ReferenceIrradiance flux = reference_irradiance(
      cloud(32), 0 * metre, 0 * deg,
      {.samples = 4000, .seed = 8, .aerosol = AerosolShape::henyey_greenstein});
  EXPECT_NEAR(flux.sky[0], 0.2722, 4 * flux.sky_error[0]);
  EXPECT_LT(flux.sky_error[0], 0.06);
}

TEST(Reference, RayleighSlabPassesTheFluxOfAddingDoubling) {
  for (TruthRow& row : read_truth("slab_rayleigh.tsv")) {
    if (row["mu"] != 1) continue;
    const double mu0 = row["mu0"];
    const ReferenceIrradiance flux = reference_irradiance(
        slab(row["tau"], 0), 0 * metre, std::acos(mu0) * rad, {.samples = 10000, .seed = 6});
    EXPECT_NEAR(flux.sun[0], row["direct"] * mu0, 1e-5);
    EXPECT_NEAR(flux.sky[0], row["diffuse"] * mu0, 4 * flux.sky_error[0]) << row["tau"];
  }
}

}  // namespace
}  // namespace skylapse::sky::monte_carlo
