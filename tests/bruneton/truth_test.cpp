// The twin against quadrature and Monte Carlo that use no tables (tests/data/atmosphere/SOURCE.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "bruneton/twins.h"
#include "support/atmosphere_truth.h"

namespace skylapse::sky::bruneton {
namespace {

Query query_of(TruthRow row) {
  return {row["height_m"] * metre, row["sun_zenith_deg"] * deg, row["view_zenith_deg"] * deg,
          row["azimuth_deg"] * deg};
}

std::array<double, 3> values_of(TruthRow row, const std::string& name) {
  return {row[name + "_680"], row[name + "_550"], row[name + "_440"]};
}

struct Pair {
  double value, truth;
};

TEST(SingleScattering, IsWithinHalfAPercentOfQuadratureInEveryGroup) {
  const Twin twin = single_scattering_twin(atmosphere::reference_medium());
  std::map<std::pair<double, double>, std::vector<Pair>> groups;
  for (TruthRow row : read_truth("single_scattering.tsv")) {
    const Answer answer = twin.answer(query_of(row));
    for (int b = 0; b < 3; ++b)
      groups[{row["height_m"], row["sun_zenith_deg"]}].push_back(
          {answer.radiance[b], values_of(row, "radiance")[b]});
  }
  ASSERT_GE(groups.size(), 6u);
  for (const auto& [group, pairs] : groups) {
    double brightest = 0;
    for (const Pair& pair : pairs) brightest = std::max(brightest, pair.truth);
    std::vector<double> errors;
    for (const Pair& pair : pairs)
      if (pair.truth > 1e-3 * brightest) errors.push_back(std::abs(pair.value / pair.truth - 1));
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() * 95 / 100], 0.005)
        << "height " << group.first << " sun " << group.second;
    EXPECT_LT(errors.back(), 0.004) << "height " << group.first << " sun " << group.second;
  }
}

/// A veil far up that is thin beside the length of a low ray: the march must not step over it. The
/// truth is the same march with eight times the nodes, which sees the veil wherever it is cut.
TEST(SingleScattering, SeesAVeilInTheStratosphereFromEverywhere) {
  atmosphere::Medium medium = green_medium();
  const atmosphere::DensityProfile veil = atmosphere::tent_profile(16 * km, 21 * km, 26 * km);
  for (atmosphere::DensityTerm term : veil.terms) {
    term.slope_per_km *= 5, term.constant *= 5;
    medium.aerosol.terms.push_back(term);
  }
  const Twin twin = single_scattering_twin(medium);
  for (const double height_m : {0.0, 11000.0, 19000.0, 40000.0, 400000.0})
    for (const double sun : {30.0, 86.2, 93.0})
      for (double below = -12; below <= 30; below += 0.5) {  // the zenith angle less that of level
        const Query query{height_m * metre, sun * deg, (90 + below) * deg, 25 * deg};
        const double truth = twin.answer(query, {.samples = 128}).radiance[0];
        // 1 %: the greatest error of single scattering that is allowed anywhere.
        EXPECT_NEAR(twin.answer(query).radiance[0], truth, 0.01 * truth + 1e-9)
            << "height " << height_m << " sun " << sun << " view " << 90 + below;
      }
}

TEST(Transmittance, AgreesWithQuadrature) {
  const Twin twin = single_scattering_twin(atmosphere::reference_medium());
  for (TruthRow row : read_truth("view_transmittance.tsv")) {
    const std::vector<double> seen =
        twin.transmittance(row["height_m"] * metre, row["view_zenith_deg"] * deg);
    for (int b = 0; b < 3; ++b) {
      const double truth = values_of(row, "transmittance")[b];
      EXPECT_NEAR(seen[b], truth, 1e-6 * truth + 1e-12) << row["view_zenith_deg"];
    }
  }
}

TEST(SunTransmittance, AgreesWithQuadrature) {
  const Twin twin = single_scattering_twin(atmosphere::reference_medium());
  for (TruthRow row : read_truth("sun_transmittance.tsv")) {
    const Answer answer = twin.answer(query_of(row));
    for (int b = 0; b < 3; ++b) {
      const double truth = values_of(row, "transmittance")[b];
      EXPECT_NEAR(answer.sun_transmittance[b], truth, 1e-6 * truth + 1e-12)
          << row["height_m"] << ' ' << row["sun_zenith_deg"];
    }
  }
}

/// Bars: rms 0.8 %, no value beyond 3 % and 4 standard errors together; the truth's own noise is
/// 0.25 % rms.
TEST(MultipleScattering, OfTheStandardTablesIsWithinMonteCarlo) {
  const Twin twin = make_twin(atmosphere::reference_medium(), Level::standard);
  double squares = 0;
  int count = 0;
  for (TruthRow row : read_truth("multiple_scattering.tsv")) {
    row["height_m"] = 1;
    const Answer answer = twin.answer(query_of(row));
    const double wavelength = row["wavelength_nm"];
    const int band = wavelength == 680 ? 0 : wavelength == 550 ? 1 : 2;
    const double error = answer.radiance[band] - row["all"];
    squares += std::pow(error / row["all"], 2);
    ++count;
    EXPECT_FALSE(std::abs(error) > 0.03 * row["all"] && std::abs(error) > 4 * row["all_error"])
        << row["sun_zenith_deg"] << ' ' << row["view_zenith_deg"] << ' ' << wavelength;
  }
  EXPECT_EQ(count, 30);
  EXPECT_LT(std::sqrt(squares / count), 0.0045);
}

}  // namespace
}  // namespace skylapse::sky::bruneton
