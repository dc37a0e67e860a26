#include "sky/atmosphere/atmosphere.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "sky/atmosphere/input_spectra.h"

namespace skylapse::sky::atmosphere {
namespace {

using testing::HasSubstr;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Vertical optical depths at a wavelength.
struct Depths {
  double rayleigh, aerosol, ozone;
};
Depths depths(const Atmosphere& air, Wavelength at) {
  const double top = air.top_height.in(km);
  return {air.rayleigh_scattering.at(at) * air.rayleigh.vertical_column_km(top),
          air.aerosol_extinction.at(at) * air.aerosol.vertical_column_km(top),
          air.ozone_absorption.at(at) * air.ozone.vertical_column_km(top)};
}

TEST(Atmosphere, VerticalDepthsAreThoseDescribed) {
  AirDescription air;
  air.aerosol_optical_depth = 0.25;
  air.ozone_du = 350;
  for (const double top : {60.0, 100.0, 150.0}) {
    air.top_height = top * km;
    const auto atmosphere = atmosphere_of(air);
    ASSERT_TRUE(atmosphere.ok());
    const Depths at_550 = depths(*atmosphere, 550.0 * nm);
    EXPECT_NEAR(at_550.rayleigh, 0.09710, 1e-7) << top;
    EXPECT_NEAR(at_550.aerosol, 0.25, 1e-12) << top;
    EXPECT_NEAR(depths(*atmosphere, 602.0 * nm).ozone, 350. / 300 * 0.0416, 1e-5) << top;
  }
}

TEST(Atmosphere, RayleighScalesWithThePressure) {
  AirDescription air;
  air.surface_pressure = 506.625 * hPa;
  EXPECT_NEAR(depths(*atmosphere_of(air), 550.0 * nm).rayleigh, 0.0971 / 2, 1e-7);
  air.surface_pressure = 0.0 * hPa;
  EXPECT_EQ(depths(*atmosphere_of(air), 550.0 * nm).rayleigh, 0);
}

TEST(Atmosphere, GroundValueOfRayleighIsThatOfAirAt15Degrees) {
  // Bodhaine et al. 1999 times the standard number density: 1.1488e-5 per metre at 550 nm. The
  // optical depth supposes another mean gravity than the standard atmosphere: 0.1 %.
  EXPECT_NEAR(atmosphere_of({})->rayleigh_scattering.at(550.0 * nm), 1.1488e-2, 2e-5);
}

TEST(Atmosphere, AerosolFollowsAngstromsLaw) {
  AirDescription air;
  air.angstrom_exponent = 1.3;
  const auto atmosphere = atmosphere_of(air);
  const double ratio =
      depths(*atmosphere, 440.0 * nm).aerosol / depths(*atmosphere, 700.0 * nm).aerosol;
  EXPECT_NEAR(ratio, std::pow(700. / 440, 1.3), 1e-4 * ratio);
}

TEST(Atmosphere, VolcanoAddsItsLayerToTheHaze) {
  AirDescription air;
  air.aerosol_optical_depth = 0.1;
  air.stratospheric_optical_depth = 0.15;
  const auto atmosphere = atmosphere_of(air);
  EXPECT_NEAR(depths(*atmosphere, 550.0 * nm).aerosol, 0.25, 1e-12);
  EXPECT_EQ(atmosphere->aerosol.at(0), 1);
  // A tent of 10 km that holds 0.15 is 0.03 per km at its peak.
  EXPECT_NEAR(atmosphere->aerosol.at(20) * atmosphere->aerosol_extinction.at(550.0 * nm), 0.03,
              1e-6);
}

TEST(Atmosphere, VolcanoAloneIsAnAtmosphereToo) {
  AirDescription air;
  air.aerosol_optical_depth = 0;
  air.stratospheric_optical_depth = 0.15;
  const auto atmosphere = atmosphere_of(air);
  EXPECT_NEAR(depths(*atmosphere, 550.0 * nm).aerosol, 0.15, 1e-12);
  EXPECT_EQ(atmosphere->aerosol.at(0), 0);
  EXPECT_NEAR(atmosphere->aerosol.at(20), 1, 1e-12);
}

TEST(Atmosphere, NothingInTheAirIsAllowed) {
  AirDescription air;
  air.aerosol_optical_depth = air.ozone_du = 0;
  air.surface_pressure = 0.0 * hPa;
  air.top_height = 10.0 * km;  // below where ozone would be
  const auto atmosphere = atmosphere_of(air);
  ASSERT_TRUE(atmosphere.ok());
  const Medium medium = medium_at(*atmosphere, band_edges(8));
  EXPECT_TRUE(check(medium).ok());
  for (const SpectralBand& band : medium.bands) {
    EXPECT_EQ(band.rayleigh_scattering_per_km, 0);
    EXPECT_EQ(band.aerosol_extinction_per_km, 0);
    EXPECT_EQ(band.ozone_absorption_per_km, 0);
    EXPECT_NEAR(band.ground_albedo, 0.2, 1e-15);
  }
}

struct Nonsense {
  std::string named;
  std::function<void(AirDescription&)> spoil;
};
class SpoiltAir : public testing::TestWithParam<Nonsense> {};

TEST_P(SpoiltAir, IsRefusedByNameWithItsRange) {
  AirDescription air;
  GetParam().spoil(air);
  const auto atmosphere = atmosphere_of(air);
  ASSERT_FALSE(atmosphere.ok());
  EXPECT_THAT(atmosphere.error().message, HasSubstr(GetParam().named));
  EXPECT_FALSE(atmosphere.error().hint.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Air, SpoiltAir,
    testing::Values(
        Nonsense{"aerosol optical depth", [](auto& a) { a.aerosol_optical_depth = -0.1; }},
        Nonsense{"aerosol optical depth", [](auto& a) { a.aerosol_optical_depth = kNan; }},
        Nonsense{"Angstrom exponent", [](auto& a) { a.angstrom_exponent = kNan; }},
        Nonsense{"single scattering albedo",
                 [](auto& a) { a.aerosol_single_scattering_albedo = 2; }},
        Nonsense{"aerosol g", [](auto& a) { a.aerosol_g = 1; }},
        Nonsense{"scale height", [](auto& a) { a.aerosol_scale_height = 0.0 * km; }},
        Nonsense{"stratospheric optical", [](auto& a) { a.stratospheric_optical_depth = -1; }},
        Nonsense{"stratospheric layer ends",
                 [](auto& a) {
                   a.stratospheric_optical_depth = 0.1;
                   a.stratospheric_top = 15.0 * km;
                 }},
        Nonsense{"stratospheric layer",
                 [](auto& a) {
                   a.stratospheric_optical_depth = 0.1;
                   a.stratospheric_top = 101.0 * km;
                 }},
        Nonsense{"ozone column", [](auto& a) { a.ozone_du = -300; }},
        Nonsense{"ozone layer", [](auto& a) { a.top_height = 30.0 * km; }},
        Nonsense{"surface pressure", [](auto& a) { a.surface_pressure = -1.0 * hPa; }},
        Nonsense{"planet radius", [](auto& a) { a.planet_radius = -6371.0 * km; }},
        Nonsense{"top of the atmosphere", [](auto& a) { a.top_height = -60.0 * km; }},
        Nonsense{"top of the atmosphere", [](auto& a) { a.top_height = kNan * km; }},
        Nonsense{"ground albedo", [](auto& a) { a.ground_albedo = constant_spectrum(2); }}));

TEST(Medium, SamplesAreTheSpectraAtTheirWavelengths) {
  const auto atmosphere = atmosphere_of({});
  const Medium medium = medium_sampled(*atmosphere, {680.0 * nm, 550.0 * nm});
  ASSERT_TRUE(check(medium).ok());
  EXPECT_EQ(medium.bands[1].wavelength_nm, 550);
  EXPECT_EQ(medium.bands[1].solar_irradiance, atmosphere->solar_irradiance.at(550.0 * nm));
  EXPECT_EQ(medium.bands[1].ozone_absorption_per_km, atmosphere->ozone_absorption.at(550.0 * nm));
  EXPECT_NEAR(medium.bands[1].aerosol_scattering_per_km,
              0.92 * medium.bands[1].aerosol_extinction_per_km, 1e-15);
  EXPECT_EQ(medium.bands[0].xyz_weight, glm::dvec3(0));
}

}  // namespace
}  // namespace skylapse::sky::atmosphere
