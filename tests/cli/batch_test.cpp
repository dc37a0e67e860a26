// The tables that scripts read.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/run_program.h"

using namespace skylapse::cli::testing;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> fields_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> fields;
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

TEST(SunBatch, KeepsRowOrderPassesOverOtherColumnsAndMatchesTheSpaReport) {
  const auto outcome = run(
      {"sun", "--batch", "-"},
      {.input = "# comment\ntag,height_m,lon_deg,utc,lat_deg,tt_minus_ut1_s,pressure_hpa,temp_c\n"
                "spa,1830.14,-105.1786,2003-10-17T19:30:30Z,39.742476,67,820,11\n"
                "b,0,0,2016-12-31T23:59:60Z,0,,,\n"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0],
            "utc,lat_deg,lon_deg,height_m,sun_az_deg,sun_el_true_deg,sun_el_app_deg,sun_dist_au,"
            "sun_radius_deg,sun_dec_deg,moon_az_deg,moon_el_true_deg,moon_dist_km,moon_radius_deg,"
            "moon_illum,moon_phase_deg");
  const auto spa = fields_of(lines[1]);
  EXPECT_EQ(spa[0], "2003-10-17T19:30:30Z");
  // Reda and Andreas 2004, table A5.1, printed to 1e-5 deg with a claimed accuracy of 3e-4 deg.
  EXPECT_NEAR(90 - std::stod(spa[6]), 50.11162, 3e-4);
  EXPECT_NEAR(std::stod(spa[4]), 194.34024, 3e-4);
  EXPECT_GE(spa[4].size() - spa[4].find('.') - 1, 9u);
  EXPECT_EQ(fields_of(lines[2])[0], "2016-12-31T23:59:60Z");
}

TEST(SunBatch, ABadRowNamesItsLine) {
  const auto outcome = run({"sun", "--batch", "-"},
                           {.input = "utc,lat_deg,lon_deg,height_m\n2026-06-21T00:00Z,5o,14,0\n"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("standard input:2:"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("lat_deg"), std::string::npos);
}

TEST(SunTable, EveryAlgorithmAnswersAndJsonParses) {
  for (const char* algorithm : {"erfa", "sg2", "preetham-atan2", "preetham"}) {
    const auto outcome = run({"sun", "--at", "50.0755,14.4378,235", "--time", "2026-06-21T12:00",
                              "--zone", "Europe/Prague", "--algorithm", algorithm, "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto rows = nlohmann::json::parse(outcome.out);
    EXPECT_NEAR(rows[0]["sun_el_true_deg"], 60.6, 1.5) << algorithm;
  }
}

TEST(EventsBatch, WritesTheColumnsAndStatesInWords) {
  const auto outcome =
      run({"events", "--batch", "-"},
          {.input = "place,lat_deg,lon_deg,height_m,zone,local_date\n"
                    "prague,50.0755,14.4378,235,Europe/Prague,2024-06-20\n"
                    "longyearbyen,78.2232,15.6267,10,Arctic/Longyearbyen,2024-12-21\n"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(
      lines[0],
      "place,lat_deg,lon_deg,height_m,zone,local_date,day_start_utc,day_end_utc,day_hours,"
      "solar_noon_utc,solar_midnight_utc,sun_el_max_deg,sun_el_min_deg,sunrise_utc,sunset_utc,"
      "civil_dawn_utc,civil_dusk_utc,nautical_dawn_utc,nautical_dusk_utc,astro_dawn_utc,"
      "astro_dusk_utc,moonrise_utc,moonset_utc");
  EXPECT_EQ(fields_of(lines[1])[13].substr(0, 19), "2024-06-20T02:52:25");
  EXPECT_EQ(fields_of(lines[1])[19], "above");
  EXPECT_EQ(fields_of(lines[2])[13], "below");
}

TEST(Probe, AppendsTheRadianceAndKeepsTheRows) {
  const auto outcome = run(
      {"probe", "--model", "hosek-wilkie", "--batch", "-"},
      {.input =
           "id,turbidity,albedo,sun_elevation_deg,view_zenith_deg,relative_azimuth_deg,band,kind\n"
           "a,2,0.1,30,0,0,560,spectral\nb,2,0.1,30,0,0,Y,xyz\nc,2,0.1,30,60,0,560,solar_direct\n"
           "d,2,0.1,30,0,0,G,rgb\n"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_TRUE(lines[1].starts_with("a,2,0.1,30,0,0,560,spectral,"));
  EXPECT_GT(std::stod(fields_of(lines[1]).back()), 0.001);
  EXPECT_GT(std::stod(fields_of(lines[3]).back()), 1000) << "the disc's centre";
}

TEST(Probe, ValuesOutsideTheModelAreRefused) {
  const std::string head =
      "turbidity,albedo,sun_elevation_deg,view_zenith_deg,relative_azimuth_deg,band,kind\n";
  for (const char* row :
       {"0.5,0,30,0,0,560,spectral", "2,1.5,30,0,0,560,spectral", "2,0,-1,0,0,560,spectral",
        "2,0,30,91,0,560,spectral", "2,0,30,0,0,800,spectral", "2,0,30,0,0,560,nonsense",
        "nan,0,30,0,0,560,spectral"}) {
    const auto outcome =
        run({"probe", "--model", "hosek-wilkie", "--batch", "-"}, {.input = head + row + "\n"});
    EXPECT_EQ(outcome.exit_code, 3) << row;
    EXPECT_EQ(outcome.out, "") << row;
  }
}

TEST(Plan, JsonNamesEachFramesSunModelAndReasons) {
  const auto folder = fresh_folder();
  const auto file = write_text(folder / "s.yaml", small_scene("{image: \"p.####.png\"}"));
  const auto outcome = run({"plan", file, "--json", "--frames", "2-4x2"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto plan = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(plan["frames"].size(), 2u);
  EXPECT_EQ(plan["frames"][0]["frame"], 2);
  EXPECT_EQ(plan["frames"][0]["model"], "hosek-wilkie");
  for (const auto& effect : plan["frames"][0]["effects"]) EXPECT_NE(effect["reason"], "");
  std::filesystem::remove_all(folder);
}

}  // namespace
