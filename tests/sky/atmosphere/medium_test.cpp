#include "sky/atmosphere/medium.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace skylapse::sky::atmosphere {
namespace {

using testing::HasSubstr;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(ReferenceMedium, HasTheNumbersOfThePublishedTruth) {
  const Medium medium = reference_medium();
  EXPECT_TRUE(check(medium).ok());
  EXPECT_EQ(medium.bottom_radius_km + medium.top_height_km, 6420);
  ASSERT_EQ(medium.bands.size(), 3u);
  const double wavelength[] = {680, 550, 440}, sun[] = {1.474, 1.8504, 1.91198};
  const double rayleigh[] = {5.802339e-03, 1.355776e-02, 3.310001e-02};
  for (int i = 0; i < 3; ++i) {
    const SpectralBand& band = medium.bands[i];
    EXPECT_EQ(band.wavelength_nm, wavelength[i]);
    EXPECT_EQ(band.solar_irradiance, sun[i]);
    EXPECT_NEAR(band.rayleigh_scattering_per_km, rayleigh[i], 5e-9);
    EXPECT_NEAR(band.aerosol_scattering_per_km, 3.996e-3, 1e-12);
    EXPECT_EQ(band.aerosol_extinction_per_km, 4.44e-3);
    EXPECT_EQ(band.ground_albedo, 0.1);
  }
  // The tent holds 15 km of its peak: 300 DU times the cross-section.
  EXPECT_NEAR(medium.bands[1].ozone_absorption_per_km * medium.ozone.vertical_column_km(60),
              300 * 2.687e20 * 3.5e-25, 1e-12);
  EXPECT_NEAR(medium.ozone.at(17.5), 17.5 / 15 - 2. / 3, 1e-15);
}

TEST(ReferenceMedium, LetsThroughWhatThePublishedTruthSays) {
  // Straight up from 1 m: view_transmittance of the published single-scattering table.
  const double expected[] = {0.940393805, 0.867685796, 0.762449269};
  const Medium m = reference_medium();
  for (int i = 0; i < 3; ++i) {
    const SpectralBand& b = m.bands[i];
    const double from_1_m =
        b.rayleigh_scattering_per_km *
            (m.rayleigh.vertical_column_km(60) - m.rayleigh.vertical_column_km(0.001)) +
        b.aerosol_extinction_per_km *
            (m.aerosol.vertical_column_km(60) - m.aerosol.vertical_column_km(0.001)) +
        b.ozone_absorption_per_km * m.ozone.vertical_column_km(60);
    EXPECT_NEAR(std::exp(-from_1_m), expected[i], 1e-8) << i;
  }
}

struct Nonsense {
  std::string named;
  std::function<void(Medium&)> spoil;
};

class SpoiltMedium : public testing::TestWithParam<Nonsense> {};

TEST_P(SpoiltMedium, IsRefusedByName) {
  Medium medium = reference_medium();
  GetParam().spoil(medium);
  const Status status = check(medium);
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, HasSubstr(GetParam().named));
  EXPECT_THAT(status.error().hint, HasSubstr("allowed"));
}

INSTANTIATE_TEST_SUITE_P(
    Medium, SpoiltMedium,
    testing::Values(
        Nonsense{"planet radius", [](Medium& m) { m.bottom_radius_km = 0; }},
        Nonsense{"planet radius", [](Medium& m) { m.bottom_radius_km = kNan; }},
        Nonsense{"top", [](Medium& m) { m.top_height_km = -1; }},
        Nonsense{"top", [](Medium& m) { m.top_height_km = 0; }},
        Nonsense{"top", [](Medium& m) { m.top_height_km = kNan; }},
        Nonsense{"top", [](Medium& m) { m.top_height_km = kInfinity; }},
        Nonsense{"sun", [](Medium& m) { m.sun_angular_radius_rad = -1e-3; }},
        Nonsense{"depolarization", [](Medium& m) { m.rayleigh_depolarization = 1.1; }},
        Nonsense{"aerosol g", [](Medium& m) { m.aerosol_g = 1; }},
        Nonsense{"aerosol g", [](Medium& m) { m.aerosol_g = -1; }},
        Nonsense{"aerosol g", [](Medium& m) { m.aerosol_g = kNan; }},
        Nonsense{"bands", [](Medium& m) { m.bands.clear(); }},
        Nonsense{"bands", [](Medium& m) { m.bands.resize(65, m.bands[0]); }},
        Nonsense{"550 nm: solar", [](Medium& m) { m.bands[1].solar_irradiance = -1; }},
        Nonsense{"550 nm: Rayleigh", [](Medium& m) { m.bands[1].rayleigh_scattering_per_km = -1; }},
        Nonsense{"550 nm: aerosol scattering",
                 [](Medium& m) { m.bands[1].aerosol_scattering_per_km = 0.005; }},
        Nonsense{"aerosol extinction",
                 [](Medium& m) { m.bands[1].aerosol_extinction_per_km = kInfinity; }},
        Nonsense{"ozone absorption", [](Medium& m) { m.bands[1].ozone_absorption_per_km = kNan; }},
        Nonsense{"ground albedo = 2", [](Medium& m) { m.bands[2].ground_albedo = 2; }},
        Nonsense{"ground albedo", [](Medium& m) { m.bands[2].ground_albedo = -0.1; }},
        Nonsense{"CIE weight", [](Medium& m) { m.bands[0].xyz_weight.y = kNan; }},
        Nonsense{"wavelength", [](Medium& m) { m.bands[0].wavelength_nm = 0; }},
        Nonsense{"ozone density terms",
                 [](Medium& m) { m.ozone.terms.resize(9, m.ozone.terms[0]); }},
        Nonsense{"ozone density term 2: top",
                 [](Medium& m) { m.ozone.terms[1].top_km = m.ozone.terms[1].bottom_km; }},
        Nonsense{"Rayleigh density term 1",
                 [](Medium& m) { m.rayleigh.terms[0].amplitude = kInfinity; }},
        Nonsense{"aerosol density", [](Medium& m) {
                   m.aerosol.terms[0].inverse_scale_height_per_km = -1e3;  // grows beyond numbers
                 }}));

TEST(Medium, ExtremesThatAreAirPass) {
  Medium medium = reference_medium();
  for (SpectralBand& band : medium.bands) {
    band.ground_albedo = 1;
    band.aerosol_scattering_per_km = band.aerosol_extinction_per_km = 0;
    band.rayleigh_scattering_per_km = band.ozone_absorption_per_km = 0;
  }
  medium.rayleigh = medium.aerosol = medium.ozone = {};
  medium.aerosol_g = -0.99;
  medium.bottom_radius_km = 60000;
  EXPECT_TRUE(check(medium).ok());
}

TEST(CanonicalText, IsEqualIfAndOnlyIfTheMediaAre) {
  const Medium plain = reference_medium();
  EXPECT_EQ(canonical_text(plain), canonical_text(reference_medium()));
  const std::function<void(Medium&)> changes[] = {
      [](Medium& m) { m.bottom_radius_km = std::nextafter(m.bottom_radius_km, 1e9); },
      [](Medium& m) { m.top_height_km += 1e-9; },
      [](Medium& m) { m.sun_angular_radius_rad *= 1 + 1e-15; },
      [](Medium& m) { m.rayleigh_depolarization = 1e-300; },
      [](Medium& m) { m.aerosol_g = -m.aerosol_g; },
      [](Medium& m) { std::swap(m.rayleigh, m.aerosol); },
      [](Medium& m) { m.ozone.terms.pop_back(); },
      [](Medium& m) { m.ozone.terms[0].constant += 1e-12; },
      [](Medium& m) { m.bands.pop_back(); },
      [](Medium& m) { m.bands[2].ozone_absorption_per_km *= 1 + 1e-15; },
      [](Medium& m) { m.bands[2].xyz_weight.z = 1e-30; },
  };
  for (const auto& change : changes) {
    Medium changed = plain;
    change(changed);
    EXPECT_NE(canonical_text(plain), canonical_text(changed));
  }
}

TEST(CanonicalText, DoesNotTellZeroFromMinusZero) {
  Medium negative = reference_medium();
  negative.bands[0].xyz_weight.x = -0.0;
  EXPECT_EQ(canonical_text(negative), canonical_text(reference_medium()));
}

}  // namespace
}  // namespace skylapse::sky::atmosphere
