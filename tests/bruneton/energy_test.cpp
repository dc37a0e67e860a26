// Light is neither made nor lost.
#include <gtest/gtest.h>

#include <cmath>

#include "bruneton/energy_balance.h"

namespace skylapse::sky::bruneton {
namespace {

TEST(Energy, IrradianceOfTheTablesIsTheIntegralOfTheRadiance) {
  const atmosphere::Medium medium = atmosphere::reference_medium();
  const auto tables = std::make_shared<const Tables>(
      precompute_twin(medium, settings_for(Level::standard, medium)));
  const Twin twin(tables);
  for (const double sun : {0.0, 30.0, 60.0, 85.0, 90.0, 94.0}) {
    const Twin::Irradiance integral = twin.irradiance(0 * km, sun * deg);
    for (int b = 0; b < 3; ++b)
      EXPECT_NEAR(table_irradiance(*tables, sun * deg, b) / integral.sky[b], 1, 0.01)
          << "sun " << sun << " band " << b;
  }
}

TEST(Energy, ConservativeAirOverAWhiteGroundLosesNothing) {
  EXPECT_NEAR(returned_share(conservative_medium(1), Level::low), 1, 0.005);
}

TEST(Energy, ConservativeThickAirOverAWhiteGroundLosesNothing) {
  atmosphere::Medium medium = conservative_medium(1);
  medium.bands[0].aerosol_extinction_per_km *= 50;  // vertical optical depth 0.27
  medium.bands[0].aerosol_scattering_per_km *= 50;
  EXPECT_NEAR(returned_share(medium, Level::low), 1, 0.01);
}

TEST(Energy, ABlackGroundUnderNoAirReturnsNothing) {
  atmosphere::Medium medium = green_medium();
  atmosphere::SpectralBand& band = medium.bands[0];
  band.rayleigh_scattering_per_km = band.aerosol_extinction_per_km = 0;
  band.aerosol_scattering_per_km = band.ozone_absorption_per_km = band.ground_albedo = 0;
  EXPECT_EQ(upward_flux(make_twin(medium), 30 * deg), 0);
}

TEST(Energy, AWhiteGroundUnderNoAirReturnsWhatFallsOnIt) {
  atmosphere::Medium medium = green_medium();
  atmosphere::SpectralBand& band = medium.bands[0];
  band.rayleigh_scattering_per_km = band.aerosol_extinction_per_km = 0;
  band.aerosol_scattering_per_km = band.ozone_absorption_per_km = 0;
  band.ground_albedo = 1;
  MarchSettings march;
  march.ground = true;
  const Answer answer = make_twin(medium).answer({0 * km, 60 * deg, 180 * deg, 0 * deg}, march);
  EXPECT_NEAR(answer.radiance[0], band.solar_irradiance * 0.5 / text::PI, 1e-12);
}

}  // namespace
}  // namespace skylapse::sky::bruneton
