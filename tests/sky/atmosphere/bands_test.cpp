// How well a few bands stand for the whole spectrum: colours of skies from n bands against 470 of
// one nanometre. The skies are a formula: light scattered once on the way down through a long view
// path, with Rayleigh, haze and ozone in the sun's path from overhead to beyond the horizon.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "data/cie1931.h"
#include "sky/atmosphere/atmosphere.h"
#include "sky/atmosphere/input_spectra.h"

namespace skylapse::sky::atmosphere {
namespace {

struct Haze {
  double depth, angstrom;
};

/// Air masses of the sun's path, of the view, of the ozone that the sun's light crosses; how much
/// more of the haze's light than of the air's goes this way.
struct Path {
  double sun_mass, view_mass, ozone_mass, haze_share;
};

std::vector<Path> paths() {
  std::vector<Path> all;
  for (const double sun : {0., 1., 2., 5., 12., 38.})
    for (const double view : {1., 3., 12., 38.})
      for (const double ozone : {0., std::min(sun, 12.)})
        for (const double haze : {0.3, 3.0}) all.push_back({sun, view, ozone, haze});
  return all;
}

Medium medium_of(const Haze& haze, const std::vector<Wavelength>& edges) {
  AirDescription air;
  air.aerosol_optical_depth = haze.depth;
  air.angstrom_exponent = haze.angstrom;
  return medium_at(*atmosphere_of(air), edges);
}

glm::dvec3 xyz_of(const Path& path, const Medium& medium) {
  const double top = medium.top_height_km;
  const double rayleigh_km = medium.rayleigh.vertical_column_km(top),
               aerosol_km = medium.aerosol.vertical_column_km(top),
               ozone_km = medium.ozone.vertical_column_km(top);
  glm::dvec3 xyz{0};
  for (const SpectralBand& band : medium.bands) {
    const double r = band.rayleigh_scattering_per_km * rayleigh_km;
    const double a = band.aerosol_extinction_per_km * aerosol_km;
    const double o = band.ozone_absorption_per_km * ozone_km;
    const double scattered =
        (r + path.haze_share * a) / (r + a) * -std::expm1(-(r + a) * path.view_mass);
    const double arriving = std::exp(-(r + a) * path.sun_mass - o * path.ozone_mass);
    xyz += band.xyz_weight * band.solar_irradiance * scattered * arriving * (1 + 2.4 * r);
  }
  return xyz;
}

/// CIE 1976 L*a*b*, white D65, the colour scaled so that `luminance` is half of white.
glm::dvec3 lab(const glm::dvec3& xyz, double luminance) {
  const auto f = [](double t) {
    return t > 216. / 24389 ? std::cbrt(t) : t * 841. / 108 + 4. / 29;
  };
  const double scale = 0.5 / luminance;
  const double x = f(xyz.x * scale / 0.95047), y = f(xyz.y * scale), z = f(xyz.z * scale / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

std::vector<Wavelength> one_nanometre_edges() {
  std::vector<Wavelength> edges;
  for (int i = 0; i <= 470; ++i) edges.push_back((360.0 + i) * nm);
  return edges;
}

/// Root mean square and greatest colour difference, greatest error of luminance.
struct Errors {
  double rms = 0, max = 0, luminance = 0;
};

Errors errors_of(const std::vector<Wavelength>& edges) {
  Errors errors;
  size_t count = 0;
  for (const Haze& haze : {Haze{0.0, 1.3}, Haze{0.1, 1.3}, Haze{0.4, 1.0}}) {
    const Medium whole = medium_of(haze, one_nanometre_edges()), bands = medium_of(haze, edges);
    for (const Path& path : paths()) {
      const glm::dvec3 truth = xyz_of(path, whole), found = xyz_of(path, bands);
      const double difference = glm::length(lab(found, truth.y) - lab(truth, truth.y));
      errors.rms += difference * difference;
      errors.max = std::max(errors.max, difference);
      errors.luminance = std::max(errors.luminance, std::abs(found.y / truth.y - 1));
      ++count;
    }
  }
  errors.rms = std::sqrt(errors.rms / static_cast<double>(count));
  return errors;
}

struct Bound {
  int bands;
  double rms, max, luminance;
};
class SkyColours : public testing::TestWithParam<Bound> {};

/// Bounds are what was measured, rounded up by a few percent: they keep it so.
TEST_P(SkyColours, OfBandsAreThoseOfTheWholeSpectrum) {
  const Errors errors = errors_of(band_edges(GetParam().bands));
  RecordProperty("rms", std::to_string(errors.rms));
  std::printf("%d bands: dE rms %.3f, max %.3f, luminance %.2f %%\n", GetParam().bands, errors.rms,
              errors.max, 100 * errors.luminance);
  EXPECT_LT(errors.rms, GetParam().rms);
  EXPECT_LT(errors.max, GetParam().max);
  EXPECT_LT(errors.luminance, GetParam().luminance);
}

INSTANTIATE_TEST_SUITE_P(Bands, SkyColours,
                         testing::Values(Bound{3, 5.3, 18, 0.25}, Bound{8, 1.1, 3.2, 0.045},
                                         Bound{16, 0.26, 0.8, 0.015}, Bound{32, 0.07, 0.2, 0.004}),
                         [](const auto& info) { return std::to_string(info.param.bands); });

TEST(BandEdges, CoverTheVisibleInOrderForEveryNumberOfBands) {
  for (int bands = 1; bands <= 64; ++bands) {
    const auto edges = band_edges(bands);
    ASSERT_EQ(edges.size(), size_t(bands) + 1);
    EXPECT_EQ(edges.front().in(nm), 360);
    EXPECT_EQ(edges.back().in(nm), 830);
    for (int i = 0; i < bands; ++i)
      EXPECT_GT((edges[i + 1] - edges[i]).in(nm), 1) << bands << " " << i;
  }
}

TEST(Bands, SunlightHasItsTrueColourWhateverTheirNumber) {
  // The whole spectrum by trapezoids of one nanometre, on the tables' own nodes.
  const Spectrum solar = solar_irradiance_spectrum();
  glm::dvec3 sun{0};
  for (size_t i = 0; i < data::kCie1931.size(); ++i)
    for (int c = 0; c < 3; ++c)
      sun[c] += solar.at(data::kCie1931WavelengthNm[i] * nm) * data::kCie1931[i][c];
  const auto atmosphere = atmosphere_of({});
  for (const int bands : {1, 2, 3, 5, 16, 33, 64}) {
    const Medium medium = medium_at(*atmosphere, band_edges(bands));
    EXPECT_TRUE(check(medium).ok()) << bands;
    glm::dvec3 xyz{0};
    for (const SpectralBand& band : medium.bands) xyz += band.xyz_weight * band.solar_irradiance;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(xyz[c] / sun[c], 1, 2e-3) << bands;
    EXPECT_NEAR(xyz.y * 683, 133.1e3, 300) << bands;  // lux outside the atmosphere
  }
}

TEST(Bands, WeightsAreNeverNegativeAndMiddlesLieInTheirBins) {
  const auto atmosphere = atmosphere_of({});
  for (int bands = 1; bands <= 64; ++bands) {
    const auto edges = band_edges(bands);
    const Medium medium = medium_at(*atmosphere, edges);
    for (int i = 0; i < bands; ++i) {
      const SpectralBand& band = medium.bands[i];
      EXPECT_GT(band.wavelength_nm, edges[i].in(nm));
      EXPECT_LT(band.wavelength_nm, edges[i + 1].in(nm));
      for (int c = 0; c < 3; ++c) EXPECT_GE(band.xyz_weight[c], 0);
    }
  }
}

TEST(Bands, OfAnyEdgesTakeMeansBetweenThem) {
  Atmosphere air = *atmosphere_of({});
  air.ground_albedo = {{400, 500}, {0.2, 0.4}};
  const Medium medium = medium_at(air, {400.0 * nm, 500.0 * nm, 700.0 * nm});
  ASSERT_EQ(medium.bands.size(), 2u);
  EXPECT_GT(medium.bands[0].ground_albedo, 0.25);
  EXPECT_LT(medium.bands[0].ground_albedo, 0.35);
  EXPECT_NEAR(medium.bands[1].ground_albedo, 0.4, 1e-12);
  EXPECT_NEAR(medium.bands[0].solar_irradiance, air.solar_irradiance.mean(400.0 * nm, 500.0 * nm),
              0);
}

}  // namespace
}  // namespace skylapse::sky::atmosphere
