#include "sky/atmosphere_disc.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sky/sun_disc.h"

namespace skylapse::sky {
namespace {

const Angle kRadius = 959.63 * arcsec;

/// Three bands whose colours are the axes.
atmosphere::Medium three_bands() {
  atmosphere::Medium medium;
  for (const double wavelength : {650.0, 550.0, 400.0}) {
    atmosphere::SpectralBand band;
    band.wavelength_nm = wavelength;
    band.solar_irradiance = 1.0 + 0.001 * wavelength;
    band.xyz_weight[int(medium.bands.size())] = 2;
    medium.bands.push_back(band);
  }
  return medium;
}

// Hestroffer and Magnan 1998 give alpha = 0.5 near 0.559 um; two formulas that meet within 0.002.
TEST(LimbDarkening, ExponentFallsWithWavelengthAndHasNoStep) {
  EXPECT_NEAR(limb_darkening_exponent(558.3 * nm), 0.5, 1e-3);
  double previous = limb_darkening_exponent(250 * nm);
  for (double wavelength = 251; wavelength < 1200; wavelength += 1) {
    const double now = limb_darkening_exponent(wavelength * nm);
    EXPECT_LE(now, previous + 1e-4) << wavelength;
    EXPECT_NEAR(now, previous, 0.006) << wavelength;
    EXPECT_GT(now, 0.2);
    previous = now;
  }
}

TEST(LimbDarkening, MeanIsThatOfTheDisc) {
  for (const double alpha : {0.0, 0.3, 0.7}) {
    double sum = 0;
    constexpr int kRings = 20000;
    for (int i = 0; i < kRings; ++i) {
      const double q2 = (i + 0.5) / kRings;  // rings of equal area
      sum += std::pow(1 - q2, 0.5 * alpha) / kRings;
    }
    EXPECT_NEAR(limb_darkening_mean(alpha), sum, 1e-5);
  }
}

// The disc's irradiance is the sun's, whatever its size. m^alpha has an infinite slope at the limb;
// the quadrature is right to 1e-4 there.
TEST(AtmosphereDisc, WithoutAirTheDiscCarriesTheSolarIrradiance) {
  const atmosphere::Medium medium = three_bands();
  const std::vector<std::vector<double>> clear(2, std::vector<double>(3, 1.0));
  for (const Angle radius : {kRadius, 1.03 * kRadius, 0.5 * deg}) {
    const AtmosphereDisc air(medium, radius, -1 * deg, 90 * deg, clear);
    const SunDisc disc{enu_direction(10 * deg, 40 * deg), radius,
                       [&](Angle e, double m) { return air.radiance_xyz(e, m); }};
    const glm::dvec3 irradiance = disc_energy(disc).normal_irradiance;
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(irradiance[c] / (2 * medium.bands[c].solar_irradiance), 1, 1e-4);
  }
}

TEST(AtmosphereDisc, TransmittanceActsPerBandAndElevation) {
  const atmosphere::Medium medium = three_bands();
  const std::vector<std::vector<double>> air{{0.0, 0.1, 0.2}, {0.4, 0.5, 0.2}, {0.8, 0.5, 0.2}};
  const std::vector<std::vector<double>> clear(3, std::vector<double>(3, 1.0));
  const AtmosphereDisc through(medium, kRadius, 2 * deg, 0.5 * deg, air);
  const AtmosphereDisc above(medium, kRadius, 2 * deg, 0.5 * deg, clear);
  const auto ratio = [&](double elevation) {
    return through.radiance_xyz(elevation * deg, 0.6) / above.radiance_xyz(elevation * deg, 0.6);
  };
  EXPECT_NEAR(ratio(2.25).x, 0.2, 1e-12);
  EXPECT_NEAR(ratio(2.25).y, 0.3, 1e-12);
  EXPECT_NEAR(ratio(2.9).x, 0.72, 1e-12);
  EXPECT_NEAR(ratio(1.0).y, 0.1, 1e-12);
  EXPECT_NEAR(ratio(7.0).x, 0.8, 1e-12);
}

TEST(AtmosphereDisc, LimbIsDarkerAndRedder) {
  const std::vector<std::vector<double>> clear(2, std::vector<double>(3, 1.0));
  const AtmosphereDisc disc(three_bands(), kRadius, 0 * deg, 90 * deg, clear);
  const glm::dvec3 centre = disc.radiance_xyz(40 * deg, 1), limb = disc.radiance_xyz(40 * deg, 0.1);
  EXPECT_LT(limb.x, 0.5 * centre.x);
  EXPECT_LT(limb.z / centre.z, 0.6 * limb.x / centre.x);
  const glm::dvec3 edge = disc.radiance_xyz(40 * deg, 0);
  EXPECT_TRUE(std::isfinite(edge.x) && edge.x >= 0);
}

}  // namespace
}  // namespace skylapse::sky
