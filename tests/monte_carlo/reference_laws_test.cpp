#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "media.h"
#include "sky/monte_carlo/path.h"
#include "sky/monte_carlo/reference.h"

namespace skylapse::sky::monte_carlo {
namespace {
using atmosphere::Medium;
using atmosphere::reference_medium;
using bruneton::Query;

const Query kAfternoon{1 * metre, 60 * deg, 70 * deg, 40 * deg};

TEST(Reference, AirThatOnlyAbsorbsFollowsBeerAndLambert) {
  Medium medium = reference_medium();
  for (atmosphere::SpectralBand& band : medium.bands) {
    band.rayleigh_scattering_per_km = 0;
    band.aerosol_scattering_per_km = 0;
    band.ground_albedo = 0;
  }
  const ReferenceAnswer answer =
      reference_answer(medium, {0 * metre, 30 * deg, 0 * deg, 0 * deg}, {.samples = 1000});
  for (size_t b = 0; b < 3; ++b) {
    const double depth =
        medium.bands[b].aerosol_extinction_per_km * medium.aerosol.vertical_column_km(60) +
        medium.bands[b].ozone_absorption_per_km * medium.ozone.vertical_column_km(60);
    EXPECT_NEAR(answer.transmittance[b], std::exp(-depth), 1e-8);
    EXPECT_EQ(answer.radiance[b], 0);
  }
}

TEST(Reference, ThinAirScattersInProportionToItsDepth) {
  // L / E0 -> p(chi) tau / mu; what is left at tau 1e-4 is of order tau.
  const double tau = 1e-4, mu = 0.5;
  const ReferenceAnswer answer = reference_answer(
      slab(tau, 0), {0 * metre, 30 * deg, std::acos(mu) * rad, 0 * deg}, {.samples = 2000});
  const double nu = std::cos(30 * deg.factor);
  const double expected = 3 / (16 * std::numbers::pi) * (1 + nu * nu) * tau / mu;
  EXPECT_NEAR(answer.radiance[0], expected, 4e-4 * expected + 4 * answer.standard_error[0]);
}

TEST(Reference, RadianceIsProportionalToTheSun) {
  Medium twice = reference_medium();
  for (atmosphere::SpectralBand& band : twice.bands) band.solar_irradiance *= 2;
  const ReferenceAnswer a = reference_answer(reference_medium(), kAfternoon, {.samples = 500});
  const ReferenceAnswer b = reference_answer(twice, kAfternoon, {.samples = 500});
  for (size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(b.radiance[i], 2 * a.radiance[i], 1e-12 * b.radiance[i]);
}

TEST(Reference, IsTheSameOnAnyNumberOfThreads) {
  const ReferenceOptions options{.samples = 5000, .seed = 42};
  ReferenceAnswer alone;
  {
    const ThreadLimit limit(1);
    alone = reference_answer(reference_medium(), kAfternoon, options);
  }
  const ReferenceAnswer together = reference_answer(reference_medium(), kAfternoon, options);
  EXPECT_EQ(alone.radiance, together.radiance);
  EXPECT_EQ(alone.standard_error, together.standard_error);
  ReferenceOptions other = options;
  other.seed = 43;
  EXPECT_NE(alone.radiance, reference_answer(reference_medium(), kAfternoon, other).radiance);
}

TEST(Reference, RunsUntilTheRelativeErrorIsReached) {
  const ReferenceAnswer answer = reference_answer(reference_medium(), kAfternoon,
                                                  {.samples = 1000000, .relative_error = 0.01});
  for (size_t b = 0; b < 3; ++b) EXPECT_LE(answer.standard_error[b], 0.01 * answer.radiance[b]);
  EXPECT_LT(answer.samples, 1000000);
  const ReferenceAnswer capped =
      reference_answer(reference_medium(), kAfternoon, {.samples = 3000, .relative_error = 1e-6});
  EXPECT_EQ(capped.samples, 3000);
}

TEST(Reference, StandardErrorsTellTheSpreadOfRepeats) {
  // 40 repeats: the mean of z^2 is 1 +- 0.22.
  const ReferenceAnswer truth =
      reference_answer(reference_medium(), kAfternoon, {.samples = 100000, .seed = 99});
  double squares = 0;
  constexpr int kRepeats = 40;
  for (int i = 0; i < kRepeats; ++i) {
    const ReferenceAnswer answer =
        reference_answer(reference_medium(), kAfternoon, {.samples = 1500, .seed = uint64_t(i)});
    const double z = (answer.radiance[1] - truth.radiance[1]) / answer.standard_error[1];
    squares += z * z / kRepeats;
  }
  EXPECT_GT(squares, 0.45);
  EXPECT_LT(squares, 1.9);
}

TEST(Reference, BandsOnOnePathAgreeWithBandsByThemselves) {
  const ReferenceAnswer together =
      reference_answer(reference_medium(), kAfternoon, {.samples = 40000, .seed = 2});
  for (size_t b = 0; b < 3; ++b) {
    Medium one = reference_medium();
    one.bands = {one.bands[b]};
    const ReferenceAnswer alone = reference_answer(one, kAfternoon, {.samples = 20000, .seed = 3});
    EXPECT_NEAR(together.radiance[b], alone.radiance[0],
                4 * std::hypot(together.standard_error[b], alone.standard_error[0]));
  }
}

TEST(Reference, TheFirstOrderAndTheOthersMakeAll) {
  struct Case {
    Query query;
    bool ground;
  };
  for (const Case& c :
       {Case{kAfternoon, false}, Case{{5 * km, 60 * deg, 100 * deg, 40 * deg}, true},
        Case{{1 * metre, 93 * deg, 80 * deg, 10 * deg}, false}}) {
    const ReferenceAnswer all = reference_answer(reference_medium(), c.query,
                                                 {.samples = 30000, .seed = 4, .ground = c.ground});
    const ReferenceAnswer first =
        reference_answer(reference_medium(), c.query,
                         {.samples = 30000, .seed = 5, .max_order = 1, .ground = c.ground});
    const ReferenceAnswer others =
        reference_answer(reference_medium(), c.query,
                         {.samples = 30000, .seed = 6, .min_order = 2, .ground = c.ground});
    for (size_t b = 0; b < 3; ++b) {
      const double error =
          std::hypot(all.standard_error[b], first.standard_error[b], others.standard_error[b]);
      EXPECT_NEAR(first.radiance[b] + others.radiance[b], all.radiance[b], 4 * error);
      EXPECT_LT(error, 0.05 * all.radiance[b]) << "not a test: too few paths";
      EXPECT_EQ(others.order1[b], 0);
    }
  }
}

/// The mean of what paths find that start into the air over bright ground.
struct Found {
  double mean = 0, error = 0;
};
Found found_with(const PathRules& rules, Angle sun_zenith, uint64_t seed) {
  const Medium medium = conservative(0.5);
  const Optics optics(medium);
  Path path(optics, rules);
  PathRadiance found;
  double sum = 0, squares = 0;
  constexpr int kPaths = 12000;
  for (int i = 0; i < kPaths; ++i) {
    PathRandom random(seed, uint64_t(i));
    path.begin({0.5, {0, 0, 1}}, glm::normalize(glm::dvec3(1, 0.2, 0.3)),
               {sin(sun_zenith), 0, cos(sun_zenith)}, i % 3, random, found);
    while (path.travel()) {
    }
    sum += found.all[1], squares += found.all[1] * found.all[1];
  }
  const double mean = sum / kPaths;
  return {mean, std::sqrt((squares / kPaths - mean * mean) / kPaths)};
}

TEST(Reference, RouletteIsWithoutBias) {
  for (const Angle sun : {50 * deg, 92 * deg}) {
    const Found without = found_with({.max_order = 8, .roulette_below = 0}, sun, 1);
    for (const double below : {0.3, 1.0, 3.0}) {
      const Found with = found_with({.max_order = 8, .roulette_below = below}, sun, 2);
      EXPECT_NEAR(with.mean, without.mean, 4 * std::hypot(with.error, without.error)) << below;
      EXPECT_LT(with.error, 0.04 * with.mean);
    }
  }
}

TEST(Reference, TheGuideOfTwilightIsWithoutBiasAndHelps) {
  // Roulette by expected light is off, for it needs the guide.
  const PathRules without{.max_order = 5, .roulette_below = 0, .guide = false};
  const PathRules with{.max_order = 5, .roulette_below = 0, .guide = true};
  for (const Angle sun : {88 * deg, 94 * deg}) {
    const Found plain = found_with(without, sun, 5), guided = found_with(with, sun, 6);
    EXPECT_NEAR(guided.mean, plain.mean, 4 * std::hypot(guided.error, plain.error));
    EXPECT_LT(guided.error, 0.08 * guided.mean);
    if (sun > 90 * deg) {
      EXPECT_LT(guided.error, 0.6 * plain.error);
    }
  }
}

TEST(Reference, DeepTwilightHasNoGaps) {
  // Where sampling by density alone finds nothing at all; the shadow of the ground ends 190 km up.
  const ReferenceAnswer answer = reference_answer(
      reference_medium(), {1 * metre, 104 * deg, 0 * deg, 0 * deg}, {.samples = 20000});
  for (size_t b = 0; b < 3; ++b) {
    EXPECT_GT(answer.radiance[b], 1e-9);
    EXPECT_LT(answer.radiance[b], 1e-7);
  }
}

TEST(Reference, TheDiscOfTheSunAgreesWithItsCentreHighInTheSky) {
  const ReferenceAnswer centre =
      reference_answer(reference_medium(), kAfternoon, {.samples = 30000});
  const ReferenceAnswer disc = reference_answer(reference_medium(), kAfternoon,
                                                {.samples = 30000, .sun = SunVisibility::disc});
  for (size_t b = 0; b < 3; ++b)
    EXPECT_NEAR(disc.radiance[b], centre.radiance[b],
                4 * std::hypot(disc.standard_error[b], centre.standard_error[b]));
}

}  // namespace
}  // namespace skylapse::sky::monte_carlo
