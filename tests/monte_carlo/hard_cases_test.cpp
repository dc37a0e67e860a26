#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "media.h"
#include "sky/monte_carlo/random.h"
#include "sky/monte_carlo/reference.h"

namespace skylapse::sky::monte_carlo {
namespace {
using atmosphere::Medium;
using atmosphere::reference_medium;

void expect_sound(const Medium& medium, const bruneton::Query& query) {
  SCOPED_TRACE(testing::Message() << "height " << query.height.in(km) << " km, sun "
                                  << query.sun_zenith.in(deg) << ", view "
                                  << query.view_zenith.in(deg) << ", " << query.azimuth.in(deg));
  const ReferenceAnswer answer = reference_answer(medium, query, {.samples = 30, .ground = true});
  ASSERT_EQ(answer.radiance.size(), medium.bands.size());
  for (size_t b = 0; b < medium.bands.size(); ++b) {
    EXPECT_TRUE(std::isfinite(answer.radiance[b]) && answer.radiance[b] >= 0);
    EXPECT_TRUE(std::isfinite(answer.standard_error[b]));
    EXPECT_TRUE(answer.transmittance[b] >= 0 && answer.transmittance[b] <= 1);
    EXPECT_TRUE(answer.sun_transmittance[b] >= 0 && answer.sun_transmittance[b] <= 1);
    EXPECT_LE(answer.order1[b], answer.up_to_order4[b] * (1 + 1e-12));
    EXPECT_LE(answer.up_to_order4[b], answer.radiance[b] * (1 + 1e-12));
  }
}

void expect_sound_everywhere(const Medium& medium) {
  for (const double height : {0.0, 1e-5, 0.001, 59.999, 60.0, 60.001, 400.0, 36000.0})
    for (const double sun : {0.0, 60.0, 90.0, 108.0, 180.0}) {
      const double r = medium.bottom_radius_km;
      const double horizon = 90 + std::acos(r / (r + height)) / deg.factor;
      for (const double view : {0.0, 90.0, horizon - 6e-5, horizon, horizon + 6e-5, 180.0})
        expect_sound(medium, {height * km, sun * deg, view * deg, 0 * deg});
      expect_sound(medium, {height * km, sun * deg, sun * deg, 0 * deg});
      expect_sound(medium, {height * km, sun * deg, (180 - sun) * deg, 180 * deg});
    }
}

TEST(ReferenceHardCases, ReferenceMedium) { expect_sound_everywhere(reference_medium()); }

TEST(ReferenceHardCases, AnyAsymmetryAndAlbedo) {
  for (const double g : {0.0, 0.99, -0.5}) {
    Medium medium = reference_medium();
    medium.aerosol_g = g;
    medium.bands[0].ground_albedo = 0;
    medium.bands[1].ground_albedo = 1;
    expect_sound_everywhere(medium);
  }
}

TEST(ReferenceHardCases, NoAir) {
  Medium medium = reference_medium();
  medium.rayleigh.terms.clear();
  medium.aerosol.terms.clear();
  medium.ozone.terms.clear();
  expect_sound_everywhere(medium);
  const ReferenceAnswer ground = reference_answer(medium, {2 * km, 0 * deg, 180 * deg, 0 * deg},
                                                  {.samples = 10, .ground = true});
  // The ground of albedo 0.1 under the bare sun.
  EXPECT_NEAR(ground.radiance[0], 0.1 / std::numbers::pi * 1.474, 1e-9);
}

TEST(ReferenceHardCases, OneComponentOnly) {
  Medium no_aerosol = reference_medium(), no_ozone = reference_medium();
  no_aerosol.aerosol.terms.clear();
  for (atmosphere::SpectralBand& band : no_ozone.bands) band.ozone_absorption_per_km = 0;
  expect_sound_everywhere(no_aerosol);
  expect_sound_everywhere(no_ozone);
}

TEST(ReferenceHardCases, FogOfTwoHundredMetresVisibility) {
  Medium medium = reference_medium();
  for (atmosphere::SpectralBand& band : medium.bands) {
    band.aerosol_extinction_per_km = 3.912 / 0.2;
    band.aerosol_scattering_per_km = 0.95 * band.aerosol_extinction_per_km;
  }
  expect_sound_everywhere(medium);
}

TEST(ReferenceHardCases, SmallAndLargePlanets) {
  for (const double radius : {400.0, 60000.0}) {
    Medium medium = reference_medium();
    medium.bottom_radius_km = radius;
    expect_sound_everywhere(medium);
  }
}

TEST(ReferenceHardCases, SixtyFourBands) {
  Medium medium = reference_medium();
  while (medium.bands.size() < 64) medium.bands.push_back(medium.bands[medium.bands.size() % 3]);
  expect_sound(medium, {1 * metre, 60 * deg, 80 * deg, 10 * deg});
}

TEST(ReferenceHardCases, NothingIsSeenWhereTheRayMissesTheAir) {
  const ReferenceAnswer up = reference_answer(
      reference_medium(), {400 * km, 30 * deg, 60 * deg, 0 * deg}, {.samples = 10});
  EXPECT_EQ(up.radiance, std::vector<double>(3, 0.0));
  EXPECT_EQ(up.transmittance, std::vector<double>(3, 1.0));
}

TEST(ReferenceHardCases, MidnightIsDark) {
  const ReferenceAnswer night = reference_answer(
      reference_medium(), {1 * metre, 180 * deg, 0 * deg, 0 * deg}, {.samples = 2000});
  for (const double radiance : night.radiance) EXPECT_LT(radiance, 1e-9);
  EXPECT_EQ(night.order1, std::vector<double>(3, 0.0));
}

TEST(ReferenceHardCases, RandomDrawsOverTheWholeDomain) {
  for (int i = 0; i < 3000; ++i) {
    PathRandom random(21, uint64_t(i));
    Medium medium = reference_medium();
    medium.aerosol_g = 1.98 * random.uniform() - 0.99;
    medium.bands[0].ground_albedo = random.uniform();
    const double haze = std::exp(8 * random.uniform() - 2);
    for (atmosphere::SpectralBand& band : medium.bands)
      band.aerosol_extinction_per_km *= haze, band.aerosol_scattering_per_km *= haze;
    const double height = std::exp(20 * random.uniform() - 9);
    const double sun = 180 * random.uniform(), view = 180 * random.uniform();
    expect_sound(medium, {height * km, sun * deg, view * deg, 360 * random.uniform() * deg});
  }
}

}  // namespace
}  // namespace skylapse::sky::monte_carlo
