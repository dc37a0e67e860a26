// Light is neither made nor lost.
#include <gtest/gtest.h>

#include <cmath>

#include "bruneton/twins.h"
#include "sky/bruneton/columns.h"

namespace skylapse::sky::bruneton {
namespace {

using text::PI;

/// The tables' irradiance on the ground at a sun zenith angle.
double table_irradiance(const Tables& tables, Angle sun_zenith, int band) {
  PhysicsData data = physics_data(tables.medium, tables.settings, 2);
  data.tables = &tables;
  text::Physics<1> text(data, band / 4);
  return text.fetch_ground(0, text.sun_row_of(cos(sun_zenith)))[band % 4];
}

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

/// Flux that leaves the top upwards under a sun, per unit of sunlight.
double upward_flux(const Twin& twin, Angle sun_zenith) {
  MarchSettings march;
  march.ground = true;
  const Length top = twin.medium().top_height_km * km;
  // Ground and limb apart: their edge is a corner.
  const double horizon =
      PI / 2 + std::acos(1 / (1 + twin.medium().top_height_km / twin.medium().bottom_radius_km));
  double flux = 0;
  for (const auto& [from, to] : {std::pair{PI / 2, horizon}, {horizon, PI}})
    for (const glm::dvec2& z : gauss_nodes(12))
      for (const glm::dvec2& a : gauss_nodes(8)) {
        const double zenith = from + (to - from) * z.x;
        const double solid = (to - from) * z.y * std::sin(zenith) * 2 * PI * a.y;
        flux -= std::cos(zenith) * solid *
                twin.answer({top, sun_zenith, zenith * rad, PI * a.x * rad}, march).radiance[0];
      }
  return flux / twin.medium().bands[0].solar_irradiance;
}

/// Share of the light on the disc of radius R + H that passes through the air unscattered.
double light_that_passes(const Twin& twin) {
  const double R = twin.medium().bottom_radius_km, top = R + twin.medium().top_height_km;
  double passed = 0;
  for (const glm::dvec2& node : gauss_nodes(40)) {
    const double b = R + (top - R) * node.x;
    const Angle zenith = (PI - std::asin(b / top)) * rad;
    passed += (top - R) * node.y * 2 * b / (top * top) *
              twin.transmittance(twin.medium().top_height_km * km, zenith)[0];
  }
  return passed;
}

/// All that the sun sends must leave, over all the planet: the sum over sun zenith angles of the
/// flux at the top is the light on the planet's disc.
double returned_share(const atmosphere::Medium& medium, Level level) {
  const Twin twin = make_twin(medium, level);
  double flux = 0;
  const double dark = 125 * PI / 180;  // nothing leaves beyond
  for (const auto& [from, to] : {std::pair{0.0, PI / 2}, {PI / 2, dark}})
    for (const glm::dvec2& node : gauss_nodes(12)) {
      const double zenith = from + (to - from) * node.x;
      flux += (to - from) * node.y * 2 * std::sin(zenith) * upward_flux(twin, zenith * rad);
    }
  return flux + light_that_passes(twin);
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
  EXPECT_NEAR(answer.radiance[0], band.solar_irradiance * 0.5 / PI, 1e-12);
}

}  // namespace
}  // namespace skylapse::sky::bruneton
