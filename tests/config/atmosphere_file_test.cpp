#include "config/atmosphere_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/job_text.h"

namespace skylapse::config {
namespace {

using sky::atmosphere::Atmosphere;
using sky::atmosphere::Medium;
using test::underlined;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

Atmosphere atmosphere_with(const std::string& text) {
  const auto air = parse_atmosphere(text, "air.yaml");
  if (!air)
    for (const Error& error : air.error()) ADD_FAILURE() << format_error(error);
  return air ? *air : Atmosphere{};
}

std::vector<std::string> errors_of(const std::string& text) {
  std::vector<std::string> lines;
  const auto air = parse_atmosphere(text, "air.yaml");
  if (air) return lines;
  for (const Error& e : air.error())
    lines.push_back(
        fmt::format("{} [{}] {} | {}", e.span.line, underlined(e.span), e.message, e.hint));
  return lines;
}

TEST(AtmosphereFile, ReferenceIsTheReferenceMedium) {
  const auto air = load_atmosphere(SKYLAPSE_SOURCE_DIR "/configs/atmospheres/reference.yaml");
  ASSERT_TRUE(air.ok()) << format_error(air.error()[0]);
  const Medium medium = medium_sampled(*air, {680.0 * nm, 550.0 * nm, 440.0 * nm});
  const Medium reference = sky::atmosphere::reference_medium();
  EXPECT_NEAR(medium.sun_angular_radius_rad, reference.sun_angular_radius_rad, 1e-18);
  Medium same = medium;
  same.sun_angular_radius_rad = reference.sun_angular_radius_rad;
  for (size_t i = 0; i < 3; ++i) {
    const auto& a = medium.bands[i];
    const auto& b = reference.bands[i];
    EXPECT_DOUBLE_EQ(a.solar_irradiance, b.solar_irradiance);
    EXPECT_DOUBLE_EQ(a.rayleigh_scattering_per_km, b.rayleigh_scattering_per_km);
    EXPECT_DOUBLE_EQ(a.aerosol_scattering_per_km, b.aerosol_scattering_per_km);
    EXPECT_DOUBLE_EQ(a.aerosol_extinction_per_km, b.aerosol_extinction_per_km);
    EXPECT_DOUBLE_EQ(a.ozone_absorption_per_km, b.ozone_absorption_per_km);
    EXPECT_DOUBLE_EQ(a.ground_albedo, b.ground_albedo);
  }
  same.bands = reference.bands;  // equal but for the last bit; radii, profiles and g exactly
  EXPECT_EQ(canonical_text(same), canonical_text(reference));
}

TEST(AtmosphereFile, EmptyOneIsTheDefaultAir) {
  const Atmosphere air = atmosphere_with("");
  const Atmosphere plain = *sky::atmosphere::atmosphere_of({});
  const auto edges = sky::atmosphere::band_edges(8);
  EXPECT_EQ(canonical_text(medium_at(air, edges)), canonical_text(medium_at(plain, edges)));
}

TEST(AtmosphereFile, PartsThatAreWrittenReplaceTheDefault) {
  const Atmosphere air = atmosphere_with(
      "top_height: 80 km\n"
      "aerosol:\n"
      "  extinction: {wavelengths: [400 nm, 0.8 um], values: [0.2, 0.1]}\n"
      "  single_scattering_albedo: {constant: 1}\n"
      "  g: -0.5\n"
      "  density:\n"
      "    - {scale_height: 2 km, density: 0.5, bottom: 1 km, top: 30 km}\n"
      "    - {peak: 20 km, bottom: 15 km, top: 30 km, density: 0.1}\n"
      "    - {intercept: 1, slope_per_km: -0.1, top: 5 km}\n");
  EXPECT_EQ(air.aerosol_g, -0.5);
  EXPECT_NEAR(air.aerosol_extinction.at(600.0 * nm), 0.15, 1e-15);
  EXPECT_NEAR(air.aerosol.at(2), 0.5 * std::exp(-1) + 0.8, 1e-15);
  EXPECT_NEAR(air.aerosol.at(0.5), 0.95, 1e-15);
  EXPECT_NEAR(air.aerosol.at(20), 0.1 + 0.5 * std::exp(-10), 1e-15);
  EXPECT_EQ(air.aerosol.at(35), 0);
  EXPECT_NEAR(air.rayleigh.at(0), 1, 1e-12);  // the default's, up to the new top
  EXPECT_GT(air.rayleigh.at(79.9), 0);
  EXPECT_EQ(air.rayleigh.at(80), 0);
}

TEST(AtmosphereFile, AllMistakesComeAtOnceWithTheirPlaces) {
  EXPECT_THAT(
      errors_of("planet_radius: -5 km\n"
                "top_hight: 60 km\n"
                "ground_albedo: {constant: 2}\n"
                "rayleigh:\n"
                "  scattering: {wavelengths: [550 nm, 440 nm], values: [1, 2, 3]}\n"
                "  density: [{scale_height: 8 km, top: 0 km}]\n"
                "aerosol: {extinction: {constant: -1}, g: 1}\n"),
      ElementsAre(
          StartsWith("1 [-5 km] planet_radius = -5 km is out of range | allowed: 1 km to 1000000"),
          StartsWith("2 [top_hight] the key \"top_hight\" is not known at the top level | did you "
                     "mean top_height?"),
          "3 [2] ground_albedo.constant is above 1 | allowed: 0 to 1",
          StartsWith("5 [[] rayleigh.scattering has 3 values at 2 wavelengths"),
          StartsWith("5 [440 nm] rayleigh.scattering.wavelengths does not rise here"),
          StartsWith("6 [0 km] rayleigh.density.0.top = 0 km is out of range"),
          StartsWith("7 [aerosol] aerosol.single_scattering_albedo is missing"),
          StartsWith("7 [aerosol] aerosol.density is missing"),
          StartsWith("7 [-1] aerosol.extinction.constant = -1 is out of range"),
          StartsWith("7 [1] aerosol.g = 1 is out of range | allowed: -0.99 to 0.99")));
}

TEST(AtmosphereFile, LayersThatAreNoneAreRefused) {
  const auto error = [](const std::string& density) {
    const auto errors = errors_of("ozone:\n  absorption: {constant: 0.01}\n  density: " + density);
    return errors.empty() ? std::string("no error") : errors[0];
  };
  EXPECT_THAT(error("[{peak: 50 km, bottom: 10 km, top: 40 km}]\n"),
              HasSubstr("ozone.density.0.peak is outside the layer | allowed: 10 km to 40 km"));
  EXPECT_THAT(error("[{scale_height: 5 km, bottom: 20 km, top: 10 km}]\n"),
              HasSubstr("ozone.density.0 ends at or below its bottom"));
  EXPECT_THAT(error("[{thickness: 5 km}]\n"),
              HasSubstr("lacks one of scale_height, peak, intercept"));
  std::string nine = "[{scale_height: 1 km}";
  for (int i = 0; i < 8; ++i) nine += ", {scale_height: 1 km}";
  EXPECT_THAT(error(nine + "]\n"), HasSubstr("has 9 pieces | allowed: at most 8"));
  EXPECT_THAT(errors_of("top_height: 20 km\n"), ElementsAre(HasSubstr("top of the ozone layer")));
  EXPECT_THAT(errors_of("- 1\n"), ElementsAre(HasSubstr("an atmosphere is a section with keys")));
}

TEST(AtmosphereFile, MissingOneSaysSo) {
  const auto air = load_atmosphere("no/such/file.yaml");
  ASSERT_FALSE(air.ok());
  EXPECT_EQ(air.error()[0].code, ErrorCode::missing_input);
}

}  // namespace
}  // namespace skylapse::config
