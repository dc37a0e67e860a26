#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "config/job_text.h"
#include "config/json_schema_validator.h"

namespace skylapse::config {
namespace {

using nlohmann::json;
using test::kSmallJob;
using test::schema_violations;
using test::with;
using test::yaml_to_json;

const json& schema() {
  static const json parsed = json::parse(job_json_schema());
  return parsed;
}

std::vector<std::filesystem::path> examples() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(SKYLAPSE_SOURCE_DIR "/configs"))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(Schema, StatesItsDraftAndRefusesUnknownKeysEverywhere) {
  EXPECT_EQ(schema()["$schema"], "https://json-schema.org/draft/2020-12/schema");
  EXPECT_EQ(schema()["additionalProperties"], false);
  ASSERT_GE(schema()["$defs"].size(), 10u);
  for (const auto& [name, section] : schema()["$defs"].items()) {
    EXPECT_EQ(section["additionalProperties"], false) << name;
    for (const auto& [key, value] : section["properties"].items())
      EXPECT_FALSE(value["description"].get<std::string>().empty()) << name << "." << key;
  }
}

TEST(Schema, AcceptsEveryExample) {
  ASSERT_GE(examples().size(), 8u);
  for (const auto& file : examples())
    EXPECT_THAT(schema_violations(schema(), yaml_to_json(text_of(file))), ::testing::IsEmpty())
        << file;
}

TEST(Examples, AreGoodJobs) {
  for (const auto& file : examples()) {
    const auto job = load_job(file.string());
    EXPECT_TRUE(job.ok()) << (job.ok() ? "" : format_error(job.error()[0]));
  }
}

/// One mistake at a time, in the demo: the schema and the reader must both refuse it.
TEST(Schema, RefusesWhatTheReaderRefuses) {
  const std::string demo = text_of(SKYLAPSE_SOURCE_DIR "/configs/prague_solstice.yaml");
  struct Mutation {
    const char* from;
    const char* to;
  };
  for (const Mutation& m : {Mutation{"height: 235 m", "height: 235"},
                            {"height: 235 m", "height: 235 s"},
                            {"height: 235 m", "heigth: 235 m"},
                            {"latitude: 50.0755 deg", "latitude: 95"},
                            {"latitude: 50.0755 deg", "latitude: 14 E"},
                            {"latitude: 50.0755 deg", "# "},
                            {"date: 2026-06-21", "date: 21.6.2026"},
                            {"from: nautical_dawn - 20 min", "from: nautical_down - 20 min"},
                            {"from: nautical_dawn - 20 min", "from: nautical_dawn - 20"},
                            {"step: 4 min", "step: 4"},
                            {"step: 4 min", "step: 4 min\n  frames: 10"},
                            {"step: 4 min", "# no step"},
                            {"visibility: 40 km", "visibility: 40 km\n  turbidity: 3"},
                            {"visibility: 40 km", "turbidity: 11"},
                            {"visibility: 40 km", "turbidity: []"},
                            {"visibility: 40 km", "preset: marsh"},
                            {"visibility: 40 km", "ozone: 300"},
                            {"visibility: 40 km", "aerosol: {g: 1}"},
                            {"visibility: 40 km", "aerosol: {albedo: 1}"},
                            {"visibility: 40 km", "stratosphere: {optical_depth: -1}"},
                            {"visibility: 40 km", "keyframes: [{ozone: 300 DU}]"},
                            {"visibility: 40 km", "keyframes: [{time: noon, ozone: 300 DU}]"},
                            {"visibility: 40 km", "keyframes: {time: 06:00}"},
                            {"ground_albedo: grass", "ground_albedo: gras"},
                            {"ground_albedo: grass", "ground_albedo: 1.5"},
                            {"projection: perspective", "projection: perspektive"},
                            {"azimuth: 270 deg", "azimuth: wets"},
                            {"fov: 100 deg", "fov: 100"},
                            {"size: 1280x720", "size: large"},
                            {"mode: sun-curve", "mode: moon-curve"},
                            {"type: half", "type: quarter"},
                            {"fps: 30", "fps: thirty"},
                            {"image: prague.####.png", "imag: prague.####.png"},
                            {"outputs:", "output:"}}) {
    const std::string bad = with(demo, m.from, m.to);
    ASSERT_FALSE(bad.empty()) << m.from;
    EXPECT_FALSE(schema_violations(schema(), yaml_to_json(bad)).empty())
        << m.from << " -> " << m.to;
    EXPECT_FALSE(parse_job(bad, "job.yaml").ok()) << m.from << " -> " << m.to;
  }
}

/// Ways of writing a value that the reader takes must not be refused by the schema.
TEST(Schema, AcceptsWhatTheReaderAccepts) {
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"50.0755 deg", "50.0755"},
           {"50.0755 deg", "50°04'32\"N"},
           {"50.0755 deg", "N 50° 4.5'"},
           {"50.0755 deg", "33 S"},
           {"14.4378 deg", "14.4378 E"},
           {"10 min", "1 h 30 min"},
           {"10 min", "500 s"},
           {"date: 2026-06-21", "dates: 2026-06-01 .. 2026-06-30"},
           {"date: 2026-06-21",
            "dates: [2026-06-01, {from: 2026-07-01, to: 2026-08-01, step: 2 weeks}]"},
           {"step: 10 min", "at: [sunrise, 04:30+02:00, 12:00Z, civil_dusk + 1 h 5 min, 24:00]"},
           {"step: 10 min", "from: 04:30 + 10 min, to: 23:59:59.5, every: 0.5 deg"},
           {"Europe/Prague", "+02:00"},
           {"look_at: west", "look_at: {azimuth: north-east, elevation: -5 deg, roll: 1 deg}"},
           {"look_at: west", "projection: cube, size: 64"},
           {"{image: sky.####.png}",
            "{image: sky.####.exr, type: half, sun: scale, compression: piz}"},
           {"{image: sky.####.png}", "{movie: a.webm, fps: 23.976, crf: 20, view: ACES SDR}"},
           {"{image: sky.####.png}", "{image: sky.####.png, view: 1.0}"},
           {"outputs:", "exposure: {ev: 14, compensation: -0.5 stops}\noutputs:"},
           {"outputs:", "exposure: {mode: metered, rate_limit: 0.25}\noutputs:"},
           {"outputs:",
            "air: {turbidity: [2, 3.5], ground_albedo: [0.2, snow], refraction: off}\noutputs:"},
           {"outputs:", "air:\nsky: {sun_disc: false}\noutputs:"},
           {"outputs:",
            "air: {preset: rural, visibility: 30 km, aerosol: {g: 0.8, scale_height: 2 km}, ozone: "
            "350 DU}\noutputs:"},
           {"outputs:",
            "air: {stratosphere: {optical_depth: 0.1, bottom: 16 km}, surface_pressure: 990 hPa, "
            "planet_radius: 6360 km, top_height: 60 km}\noutputs:"},
           {"outputs:",
            "air: {keyframes: [{time: 06:00, visibility: 9 km}, {time: sunset + 10 min, ozone: 350 "
            "DU}]}\noutputs:"},
           {"outputs:", "sky: {model: bruneton, level: draft, wavelengths: 3}\noutputs:"},
           {"outputs:", "title: 2026\noutputs:"}}) {
    const std::string good = with(kSmallJob, from, to);
    EXPECT_THAT(schema_violations(schema(), yaml_to_json(good)), ::testing::IsEmpty()) << to;
    EXPECT_EQ(test::error_of(good), "no error") << to;
  }
}

}  // namespace
}  // namespace skylapse::config
