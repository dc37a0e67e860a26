// probe of the models that compute an atmosphere, as a user runs it.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "run_program.h"

using namespace skylapse::cli::testing;

namespace {

const std::string kHead =
    "sun_zenith_deg,view_zenith_deg,relative_azimuth_deg,altitude_m,wavelength_nm\n";
const std::string kReference =
    std::string(SKYLAPSE_SOURCE_DIR) + "/configs/atmospheres/reference.yaml";

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> fields;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) fields.push_back(cell);
    rows.push_back(fields);
  }
  return rows;
}

/// The tables lie in a folder of the tests' own.
Outcome probe(std::vector<std::string> options, const std::string& rows) {
  static const std::filesystem::path cache = fresh_folder();
  std::vector<std::string> arguments{"probe", "--batch", "-"};
  if (std::ranges::find(options, "bruneton") != options.end())
    arguments.insert(arguments.end(), {"--level", "draft"});
  arguments.insert(arguments.end(), options.begin(), options.end());
  return run(arguments,
             {.input = kHead + rows, .environment = {"XDG_CACHE_HOME=" + cache.string()}});
}

double value(const Outcome& outcome, size_t row, const std::string& column) {
  const auto rows = rows_of(outcome.out);
  const auto& names = rows.at(0);
  const size_t c = size_t(std::find(names.begin(), names.end(), column) - names.begin());
  return std::stod(rows.at(row + 1).at(c));
}

// tests/data/atmosphere/single_scattering.tsv: 1 m, sun 60 deg, view straight up.
TEST(ProbeAtmosphere, SingleScatteringIsThatOfThePublishedTable) {
  for (const char* precision : {"double", "float"}) {
    const auto outcome = probe(
        {"--model", "single-scattering", "--precision", precision, "--atmosphere", kReference},
        "60,0,0,1,680\n60,0,0,1,440\n60,0,45,1,550\n");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NEAR(value(outcome, 0, "radiance") / 0.00480958071, 1, 1e-4) << precision;
    EXPECT_NEAR(value(outcome, 1, "radiance") / 0.0254107893, 1, 1e-4) << precision;
    EXPECT_NEAR(value(outcome, 2, "radiance") / 0.0121642593, 1, 1e-4) << precision;
  }
}

TEST(ProbeAtmosphere, AppendsItsColumnsAndKeepsTheRows) {
  const auto outcome =
      probe({"--model", "bruneton", "--precision", "double"}, "30,45,120.50,2000,555\n");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto rows = rows_of(outcome.out);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0],
            (std::vector<std::string>{"sun_zenith_deg", "view_zenith_deg", "relative_azimuth_deg",
                                      "altitude_m", "wavelength_nm", "radiance", "transmittance",
                                      "sun_transmittance", "irradiance_sun", "irradiance_sky"}));
  EXPECT_EQ(rows[1][2], "120.50");
  EXPECT_GE(rows[1][5].size(), 13u) << "12 digits and more";
  // By day the sun gives more than the sky, and both less than the sun above the air.
  EXPECT_GT(value(outcome, 0, "irradiance_sun"), value(outcome, 0, "irradiance_sky"));
  EXPECT_LT(value(outcome, 0, "irradiance_sun"), 2);
  EXPECT_GT(value(outcome, 0, "sun_transmittance"), 0.7);
}

// GL and the twin have tables and marches of their own: within 1e-3, twilight included.
TEST(ProbeAtmosphere, FloatAgreesWithDouble) {
  const std::string rows =
      "30,45,120,2000,555\n80,88,10,0,450\n95,85,0,1,620\n60,120,30,400000,550\n";
  const auto on_gl = probe({"--model", "bruneton", "--precision", "float"}, rows);
  const auto twin = probe({"--model", "bruneton", "--precision", "double"}, rows);
  ASSERT_EQ(on_gl.exit_code, 0) << on_gl.err;
  ASSERT_EQ(twin.exit_code, 0) << twin.err;
  for (size_t row = 0; row < 4; ++row) {
    EXPECT_NEAR(value(on_gl, row, "radiance") / value(twin, row, "radiance"), 1, 1e-3) << row;
    EXPECT_NEAR(value(on_gl, row, "transmittance"), value(twin, row, "transmittance"), 1e-4) << row;
  }
}

TEST(ProbeAtmosphere, EveryRowHasItsOwnWavelengthHoweverMany) {
  std::string rows;
  for (int i = 0; i < 70; ++i) rows += "60,30,0,0," + std::to_string(400 + 5 * (69 - i)) + "\n";
  const auto outcome = probe({"--model", "single-scattering", "--precision", "double"}, rows);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  // Down to 400 nm the zenith's transmittance only falls, band by band (ozone's bump apart).
  EXPECT_GT(value(outcome, 0, "transmittance"), 1.15 * value(outcome, 69, "transmittance"));
  const auto alone =
      probe({"--model", "single-scattering", "--precision", "double"}, "60,30,0,0,500\n");
  EXPECT_EQ(value(alone, 0, "radiance"), value(outcome, 49, "radiance"));
}

TEST(ProbeAtmosphere, ReferenceStatesItsErrorAndIsRepeatable) {
  const std::vector<std::string> options{"--model", "reference", "--samples",
                                         "2000",    "--seed",    "7"};
  const auto outcome = probe(options, "60,30,0,0,550\n");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto twin = probe({"--model", "bruneton", "--precision", "double"}, "60,30,0,0,550\n");
  const double error = value(outcome, 0, "standard_error");
  EXPECT_GT(error, 0);
  EXPECT_LT(error, 0.05 * value(outcome, 0, "radiance"));
  EXPECT_NEAR(value(outcome, 0, "radiance"), value(twin, 0, "radiance"),
              4 * error + 0.02 * value(twin, 0, "radiance"));
  EXPECT_EQ(probe(options, "60,30,0,0,550\n").out, outcome.out);
}

TEST(ProbeAtmosphere, NonsenseIsRefusedAtItsCellOrOption) {
  for (const char* row : {"181,0,0,0,550", "30,-1,0,0,550", "30,0,0,-1,550", "30,0,0,0,200",
                          "nan,0,0,0,550", "30,0,inf,0,550", "30,0,0,0,"}) {
    const auto outcome = probe({"--model", "bruneton"}, std::string(row) + "\n");
    EXPECT_EQ(outcome.exit_code, 3) << row;
    EXPECT_EQ(outcome.out, "") << row;
  }
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--model", "brunetom"},
                                                  {"--model", "bruneton", "--precision", "half"},
                                                  {"--model", "bruneton", "--backend", "metal"},
                                                  {"--model", "reference", "--relative-error", "2"},
                                                  {"--model", "reference", "--samples", "-5"},
                                                  {"--model", "reference", "--samples", "0"}})
    EXPECT_EQ(probe(options, "30,0,0,0,550\n").exit_code, 3) << options.back();
  EXPECT_EQ(
      probe({"--model", "bruneton", "--atmosphere", "nowhere.yaml"}, "30,0,0,0,550\n").exit_code,
      4);
}

TEST(ProbeAtmosphere, JsonCarriesNumbers) {
  const auto outcome = probe({"--model", "single-scattering", "--json"}, "30,45,120,2000,555\n");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto rows = nlohmann::json::parse(outcome.out);
  EXPECT_TRUE(rows[0]["radiance"].is_number());
  EXPECT_EQ(rows[0]["wavelength_nm"], 555);
}

}  // namespace
