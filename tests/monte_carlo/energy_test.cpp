// Light is neither made nor lost.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "media.h"
#include "sky/monte_carlo/random.h"
#include "sky/monte_carlo/reference.h"

namespace skylapse::sky::monte_carlo {
namespace {

/// The mean over all directions of the sun of radiance x 4 pi / irradiance: what the point would
/// see under light of radiance 1 from everywhere, but for what comes to it unscattered.
struct Furnace {
  double mean = 0, error = 0;
};
Furnace furnace(const atmosphere::Medium& medium, Length height, Angle view_zenith, size_t band) {
  constexpr int kSuns = 700;
  double sum = 0, squares = 0;
  for (int i = 0; i < kSuns; ++i) {
    PathRandom random(11, uint64_t(i));
    const Angle zenith = std::acos(2 * random.uniform() - 1) * rad;
    const Angle azimuth = 2 * std::numbers::pi * random.uniform() * rad;
    const ReferenceAnswer answer =
        reference_answer(medium, {height, zenith, view_zenith, azimuth},
                         {.samples = 32, .seed = uint64_t(i), .ground = true});
    const double x = 4 * std::numbers::pi * answer.radiance[band];
    sum += x, squares += x * x;
  }
  const double mean = sum / kSuns;
  return {mean, std::sqrt((squares / kSuns - mean * mean) / kSuns)};
}

TEST(Energy, AWhiteFurnaceIsWhiteSeenDownwards) {
  for (const Length height : {1.0 * metre, 20.0 * km, 400.0 * km}) {
    const Furnace seen = furnace(conservative(1), height, 150 * deg, 2);
    EXPECT_NEAR(seen.mean, 1, 4 * seen.error) << height.in(km);
    EXPECT_LT(seen.error, 0.06);
  }
}

TEST(Energy, AWhiteFurnaceIsWhiteSeenUpwards) {
  for (const Angle zenith : {20 * deg, 80 * deg, 89 * deg}) {
    const atmosphere::Medium medium = conservative(1);
    const ReferenceAnswer ray = reference_answer(medium, {1 * metre, 50 * deg, zenith, 0 * deg},
                                                 {.samples = 1, .max_order = 1});
    const Furnace seen = furnace(medium, 1 * metre, zenith, 2);
    EXPECT_NEAR(seen.mean + ray.transmittance[2], 1, 4 * seen.error) << zenith.in(deg);
    EXPECT_LT(seen.error, 0.07);
  }
}

// Thick and strongly forward scattering air, where rounding or roulette would show.
TEST(Energy, AWhiteFurnaceStaysWhiteInHaze) {
  atmosphere::Medium medium = conservative(1);
  medium.aerosol_g = 0.9;
  for (atmosphere::SpectralBand& band : medium.bands) {
    band.aerosol_scattering_per_km *= 100;
    band.aerosol_extinction_per_km *= 100;
  }
  const Furnace seen = furnace(medium, 2 * km, 120 * deg, 1);
  EXPECT_NEAR(seen.mean, 1, 4 * seen.error);
  EXPECT_LT(seen.error, 0.06);
}

TEST(Energy, WhatGoesIntoAConservativeSlabComesOut) {
  // Flux down at the ground is swallowed (albedo 0); flux up at the top by integration over views.
  const atmosphere::Medium medium = slab(0.5, 0);
  const Angle sun = 60 * deg;
  const ReferenceIrradiance down =
      reference_irradiance(medium, 0 * metre, sun, {.samples = 20000, .seed = 3});
  double up = 0, variance = 0;
  constexpr int kViews = 400;
  for (int i = 0; i < kViews; ++i) {
    PathRandom random(12, uint64_t(i));
    const double mu = std::sqrt((i + random.uniform()) / kViews);  // by cosine, in strata
    const Angle azimuth = 2 * std::numbers::pi * random.uniform() * rad;
    const ReferenceAnswer answer =
        reference_answer(medium, {1 * km, sun, std::acos(-mu) * rad, azimuth},
                         {.samples = 100, .seed = uint64_t(i)});
    up += std::numbers::pi * answer.radiance[0] / kViews;
    variance += std::pow(std::numbers::pi * answer.standard_error[0] / kViews, 2);
  }
  const double incoming = std::cos(sun.in(rad));
  // The azimuth's strata add what they add: 0.3 % covers 400 random azimuths of a 20 % variation.
  EXPECT_NEAR(down.sun[0] + down.sky[0] + up, incoming,
              4 * std::hypot(down.sky_error[0], std::sqrt(variance)) + 0.003 * incoming);
}

TEST(Energy, SunAndViewOfASlabMayBeExchanged) {
  // Reciprocity: reflected radiance over the sun's cosine is symmetric.
  const atmosphere::Medium medium = slab(1, 0.3);
  const auto reflected = [&](double sun_zenith, double view_zenith, double& error) {
    const ReferenceAnswer answer =
        reference_answer(medium, {1 * km, sun_zenith * deg, (180 - view_zenith) * deg, 70 * deg},
                         {.samples = 40000, .seed = 9, .ground = true});
    error = answer.standard_error[0] / std::cos(sun_zenith * deg.factor);
    return answer.radiance[0] / std::cos(sun_zenith * deg.factor);
  };
  for (const auto& [a, b] : {std::pair{20.0, 75.0}, {50.0, 80.0}, {5.0, 40.0}}) {
    double error_a = 0, error_b = 0;
    const double there = reflected(a, b, error_a), back = reflected(b, a, error_b);
    EXPECT_NEAR(there, back, 4 * std::hypot(error_a, error_b));
    EXPECT_LT(error_a, 0.01 * there);
  }
}

}  // namespace
}  // namespace skylapse::sky::monte_carlo
