// A library of skies with every kind of output: whole, in shards, killed and resumed, it is the
// same to the byte.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "cli/run_program.h"
#include "core/sha256.h"

using namespace skylapse::cli::testing;
using nlohmann::json;

namespace {

constexpr const char* kLibrary = R"(
title: every kind of output
locations:
  - {name: Prague, latitude: 50.0755 deg, longitude: 14.4378 deg}
  - {name: Cape Town, latitude: -33.9249 deg, longitude: 18.4241 deg}
time: {zone: UTC, date: 2026-06-21, sun_elevations: [60 deg, 10 deg, 25 deg], half: morning}
camera: {projection: lat-long, size: 64x32}
outputs:
  - image: "{site}/{sun_elevation}_{size}.exr"
  - image: "{site}/{sun_elevation}_sky.exr"
    content: sky
    type: half
  - image: "{site}/{sun_elevation}.hdr"
    sun: scale
  - image: "{site}/{sun_elevation}_{face}.exr"
    projection: cube
    size: 8
    layout: faces
    orientation: unreal
  - image: "{site}/{sun_elevation}_oct.exr"
    projection: octahedral
    size: 32
    type: half
    sun: split
  - image: "{site}/{sun_elevation}.ktx2"
    projection: cube
    size: 8
    sun: scale
  - specular: "{site}/{sun_elevation}_specular.ktx2"
    size: 8
  - specular: "{site}/{sun_elevation}_specular_{level}_{face}.exr"
    size: 8
  - irradiance: "{site}/{sun_elevation}_irradiance.hdr"
    size: 8
  - harmonics: "{site}/{sun_elevation}_sh.json"
  - sun: "{site}/{sun_elevation}_sun.json"
  - sun: "{site}/{sun_elevation}_sun.usda"
  - dome: "{site}/{sun_elevation}_dome.usda"
    map: "{site}/{sun_elevation}_sky.exr"
  - image: "preview/{site}_{sun_elevation}.png"
    size: 48x24
  - gallery: index.html
    image: "preview/{site}_{sun_elevation}.png"
  - sheet: contact.png
    image: "preview/{site}_{sun_elevation}.png"
    columns: 2
)";
constexpr size_t kFrames = 5;  // in June the sun reaches 60 deg in Prague, not in Cape Town
// 6 images and 6 faces; 1 specular, and 2 levels of 6 faces; irradiance, harmonics, 2 suns, dome.
constexpr size_t kFilesPerFrame = 6 + 6 + 1 + 12 + 1 + 1 + 2 + 1;

std::map<std::string, std::string> visible_files(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const auto name = std::filesystem::relative(entry.path(), folder).string();
    const bool hidden = name.starts_with(".") || entry.path().filename().string().starts_with(".");
    if (!entry.is_regular_file() || hidden || name == "manifest.json") continue;
    std::ifstream in(entry.path(), std::ios::binary);
    std::ostringstream bytes;
    bytes << in.rdbuf();
    files[name] = skylapse::sha256_hex(bytes.str());
  }
  return files;
}

void drop_milliseconds(json& value) {
  if (value.is_object()) value.erase("milliseconds");
  if (value.is_structured())
    for (json& below : value) drop_milliseconds(below);
}

/// All that a manifest says but how long things took.
json manifest_of(const std::filesystem::path& folder) {
  std::ifstream file(folder / "manifest.json");
  json manifest = json::parse(file, nullptr, false);
  drop_milliseconds(manifest);
  return manifest;
}

class LibraryJob : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new std::filesystem::path(fresh_folder());
    scene_ = new std::string(write_text(*folder_ / "s.yaml", kLibrary).string());
    const auto outcome = run({"render", *scene_, "-o", *folder_ / "whole", "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  static void TearDownTestSuite() {
    std::filesystem::remove_all(*folder_);
    delete folder_;
    delete scene_;
  }
  static std::filesystem::path whole() { return *folder_ / "whole"; }
  void expect_as_whole(const std::filesystem::path& out) {
    const auto files = visible_files(out), expected = visible_files(whole());
    EXPECT_EQ(files.size(), expected.size());
    for (const auto& [name, hash] : expected) {
      const auto found = files.find(name);
      ASSERT_NE(found, files.end()) << name;
      EXPECT_EQ(found->second, hash) << name;
    }
    EXPECT_EQ(manifest_of(out), manifest_of(whole()));
  }

  static std::filesystem::path* folder_;
  static std::string* scene_;
};
std::filesystem::path* LibraryJob::folder_ = nullptr;
std::string* LibraryJob::scene_ = nullptr;

TEST_F(LibraryJob, HasEveryFileOnceAndSaysSo) {
  const json manifest = manifest_of(whole());
  ASSERT_EQ(manifest["frames"].size(), kFrames);
  EXPECT_EQ(manifest["complete"], true);
  std::map<std::string, std::string> told;
  for (const auto& frame : manifest["frames"]) {
    EXPECT_EQ(frame["files"].size(), kFilesPerFrame);
    for (const auto& file : frame["files"]) told[file["path"]] = file["sha256"];
  }
  EXPECT_EQ(manifest["library"].size(), 2u);
  for (const auto& file : manifest["library"]) told[file["path"]] = file["sha256"];
  EXPECT_EQ(told, visible_files(whole()));
  EXPECT_EQ(told.size(), kFrames * kFilesPerFrame + 2);
  for (const auto& [name, hash] : told) EXPECT_EQ(name.find(' '), std::string::npos) << name;
  EXPECT_TRUE(told.contains("Cape-Town/+25.00_64x32.exr"));
  // The sun that is not high enough is told of.
  ASSERT_EQ(manifest["notes"].size(), 1u);
  EXPECT_NE(manifest["notes"][0].get<std::string>().find("does not rise through 60 deg"),
            std::string::npos);
}

TEST_F(LibraryJob, InThreeShardsItIsTheSame) {
  const auto out = *folder_ / "shards";
  for (const char* shard : {"3/3", "1/3", "2/3"}) {
    EXPECT_FALSE(std::filesystem::exists(out / "index.html"));
    const auto outcome = run({"render", *scene_, "-o", out, "--shard", shard, "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  expect_as_whole(out);
}

TEST_F(LibraryJob, KilledAndResumedItIsTheSame) {
  const auto out = *folder_ / "killed";
  for (const size_t after : {1u, 20u, 70u}) {
    run({"render", *scene_, "-o", out, "-q", "--jobs", "1"}, {.while_running = [&](pid_t child) {
          for (int i = 0; i < 2000 && visible_files(out).size() < after; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
          kill(child, SIGKILL);
        }});
    const auto expected = visible_files(whole());
    for (const auto& [name, hash] : visible_files(out)) ASSERT_EQ(hash, expected.at(name)) << name;
  }
  const auto last = run({"render", *scene_, "-o", out, "-q"});
  ASSERT_EQ(last.exit_code, 0) << last.err;
  expect_as_whole(out);
}

TEST_F(LibraryJob, ADamagedFileOfAnyKindIsMadeAgain) {
  const auto out = *folder_ / "damaged";
  std::filesystem::copy(whole(), out, std::filesystem::copy_options::recursive);
  const std::string sky = "Cape-Town/+10.00";
  std::ofstream(out / (sky + "_specular.ktx2")) << "damaged";
  std::ofstream(out / "index.html") << "damaged";
  std::filesystem::remove(out / "contact.png");
  std::filesystem::remove(out / (sky + "_sun.usda"));
  const auto outcome = run({"render", *scene_, "-o", out, "-q"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_as_whole(out);
}

TEST_F(LibraryJob, PartOfItHasNoGalleryAndSaysSo) {
  const auto outcome = run({"render", *scene_, "-o", *folder_ / "part", "--frames", "1"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(*folder_ / "part" / "index.html"));
  EXPECT_NE(outcome.err.find("index.html is left out"), std::string::npos) << outcome.err;
}

TEST_F(LibraryJob, ThePlanKnowsItsFilesAndCosts) {
  const auto outcome = run({"plan", *scene_, "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json plan = json::parse(outcome.out);
  ASSERT_EQ(plan["frames"].size(), kFrames);
  EXPECT_EQ(plan["frames"][0]["files"].size(), kFilesPerFrame);
  EXPECT_EQ(plan["estimate"]["outputs"].size(), 16u);
  EXPECT_GT(plan["estimate"]["picture_memory_bytes"], 0);
  for (const auto& frame : plan["frames"])
    for (const auto& file : frame["files"])
      EXPECT_TRUE(std::filesystem::exists(whole() / file.get<std::string>())) << file;
}

}  // namespace
