// Pictures as they are compared, and what must agree beside their pixels.
#include "diff/facts.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "diff/pairs.h"
#include "output/atomic_file.h"
#include "pipeline/job_fixture.h"
#include "pipeline/output_view.h"

namespace skylapse::diff {
namespace {

using output::Attribute;

const output::ImageIo& image_io() { return **output::open_image_io(); }

/// A small picture with these attributes.
std::string write_picture(const TemporaryFolder& folder, const std::string& name,
                          std::vector<Attribute> attributes,
                          output::SampleType type = output::SampleType::float32) {
  const std::vector<float> pixels(size_t{3} * 8 * 4, 0.5F);
  const std::vector<uint8_t> codes(size_t{3} * 8 * 4, 100);
  output::EncodeRequest request;
  request.format = name.substr(name.rfind('.') + 1);
  request.width = 8;
  request.height = 4;
  request.type = type;
  request.pixels = type == output::SampleType::u8 ? static_cast<const void*>(codes.data())
                                                  : static_cast<const void*>(pixels.data());
  request.attributes = std::move(attributes);
  const auto bytes = image_io().encode(request);
  EXPECT_TRUE(bytes.ok());
  EXPECT_TRUE(output::write_file_atomically(folder / name, *bytes).ok());
  return (folder / name).string();
}

PictureFacts facts_of(const std::string& path) {
  auto picture = read_picture(path, {});
  if (!picture) {
    ADD_FAILURE() << picture.error().message;
    return {};
  }
  return picture->facts;
}

std::vector<std::string> checks_of(const std::vector<Finding>& findings) {
  std::vector<std::string> checks;
  for (const Finding& f : findings) checks.push_back(f.check);
  return checks;
}

std::vector<Attribute> noon() {
  return {{"skylapse:utc", std::string("2026-06-21T11:00:00.000000Z")},
          {"skylapse:sunAzimuth", 178.0},
          {"skylapse:sunElevation", 63.0},
          {"skylapse:sunRadius", 0.2623},
          {"skylapse:colorSpace", std::string("rec709")},
          {"whiteLuminance", 683.0F},
          {"skylapse:projection", std::string("lat-long")},
          {"skylapse:orientation", std::string("openexr")},
          {"skylapse:heading", 0.0},
          {"skylapse:content", std::string("radiance")},
          {"latitude", 50.0F},
          {"longitude", 14.4F}};
}

void set(std::vector<Attribute>& all, const std::string& name, decltype(Attribute::value) value) {
  for (Attribute& a : all)
    if (a.name == name) a.value = value;
}

TEST(CompareFacts, EachFactThatDisagreesIsAFailureOfItsOwn) {
  struct Case {
    const char* attribute;
    decltype(Attribute::value) value;
    const char* check;
  };
  const Case cases[] = {
      {"skylapse:utc", std::string("2026-06-21T11:00:01.000000Z"), "metadata.time"},
      {"skylapse:sunAzimuth", 178.1, "metadata.sun"},
      {"skylapse:sunElevation", 63.02, "metadata.sun"},
      {"skylapse:sunRadius", 0.27, "metadata.sun"},
      {"skylapse:colorSpace", std::string("acescg"), "metadata.units"},
      {"whiteLuminance", 1.0F, "metadata.units"},
      {"skylapse:projection", std::string("octahedral"), "metadata.projection"},
      {"skylapse:orientation", std::string("usd"), "metadata.orientation"},
      {"skylapse:heading", 90.0, "metadata.orientation"},
      {"skylapse:content", std::string("sky without disc"), "metadata.content"},
      {"latitude", 50.1F, "metadata.site"},
      {"longitude", 14.5F, "metadata.site"}};
  const TemporaryFolder folder;
  const auto a = facts_of(write_picture(folder, "a.exr", noon()));
  for (const Case& c : cases) {
    auto changed = noon();
    set(changed, c.attribute, c.value);
    const auto findings = compare_facts(a, facts_of(write_picture(folder, "b.exr", changed)));
    ASSERT_EQ(checks_of(findings), std::vector<std::string>{c.check}) << c.attribute;
    EXPECT_EQ(findings[0].severity, Verdict::different);
    EXPECT_NE(findings[0].message.find(" in A and "), std::string::npos) << findings[0].message;
  }
}

TEST(CompareFacts, WhatOneFileDoesNotTellAndWhoWroteItAreInnocent) {
  const TemporaryFolder folder;
  const auto a = facts_of(write_picture(folder, "a.exr", noon()));
  EXPECT_TRUE(compare_facts(a, facts_of(write_picture(folder, "silent.exr", {}))).empty());
  for (const auto& more :
       {Attribute{"Software", std::string("other")}, Attribute{"skylapse:model", std::string("x")},
        Attribute{"skylapse:fingerprint", std::string("x")},
        Attribute{"capDate", std::string("2031:01:02 03:04:05")}}) {
    auto attributes = noon();
    attributes.push_back(more);
    EXPECT_TRUE(compare_facts(a, facts_of(write_picture(folder, "b.exr", attributes))).empty())
        << more.name;
  }
}

TEST(CompareFacts, PngTellsTheSameAsExr) {
  const TemporaryFolder folder;
  const auto exr = facts_of(write_picture(folder, "a.exr", noon()));
  const auto png = facts_of(write_picture(folder, "a.png", noon(), output::SampleType::u8));
  ASSERT_TRUE(png.view.sun && png.view.camera);
  EXPECT_LT(separation(*png.view.sun, *exr.view.sun).in(deg), 1e-9);
  EXPECT_EQ(png.latitude_deg, exr.latitude_deg);
  EXPECT_EQ(checks_of(compare_facts(exr, png)), std::vector<std::string>{"stored-type"});
}

TEST(CompareFacts, FewerBitsWarnAndMoreDoNot) {
  const TemporaryFolder folder;
  const auto whole = facts_of(write_picture(folder, "a.exr", {}));
  const auto half = facts_of(write_picture(folder, "b.exr", {}, output::SampleType::half_float));
  const auto findings = compare_facts(whole, half);
  ASSERT_EQ(checks_of(findings), std::vector<std::string>{"stored-type"});
  EXPECT_EQ(findings[0].severity, Verdict::warning);
  EXPECT_EQ(findings[0].message, "B is stored in fewer bits: R, G, B is float in A and half in B");
  EXPECT_TRUE(compare_facts(half, whole).empty());
}

TEST(CompareFacts, HostileAttributesTellNothing) {
  const TemporaryFolder folder;
  auto attributes = noon();
  set(attributes, "skylapse:sunElevation", 1e300);
  set(attributes, "skylapse:heading", std::nan(""));
  set(attributes, "skylapse:projection", std::string("lat-long"));
  set(attributes, "whiteLuminance", std::string("683; drop"));
  const auto facts = facts_of(write_picture(folder, "a.exr", attributes));
  EXPECT_FALSE(facts.view.sun);
  EXPECT_FALSE(facts.view.camera);
  EXPECT_FALSE(facts.white_luminance);
}

TEST(ReadPicture, MapsOfOtherProgramsHaveHeadingZero) {
  const TemporaryFolder folder;
  const auto facts = facts_of(
      write_picture(folder, "a.exr", {{"textureformat", std::string("LatLong Environment")}}));
  ASSERT_TRUE(facts.view.camera);
  const auto centre = image::direction_at(*facts.view.camera, {4, 2});
  EXPECT_LT(separation(*centre, enu_direction({}, {})).in(deg), 1e-9);
}

TEST(ReadPicture, MirroredMapsHaveNoCamera) {
  auto attributes = noon();
  set(attributes, "skylapse:orientation", std::string("pbrt"));
  const TemporaryFolder folder;
  EXPECT_FALSE(facts_of(write_picture(folder, "a.exr", attributes)).view.camera);
}

/// Every projection, turned every way: what files and manifests tell gives the camera that rendered
/// them back.
class RebuiltCamera : public testing::TestWithParam<const char*> {};

void expect_same_directions(const image::Camera& rebuilt, const image::Camera& made) {
  ASSERT_EQ(rebuilt.width, made.width);
  ASSERT_EQ(rebuilt.height, made.height);
  for (int y = 0; y < made.height; ++y) {
    for (int x = 0; x < made.width; ++x) {
      const image::PixelPosition centre{x + 0.5, y + 0.5};
      const auto a = image::direction_at(made, centre), b = image::direction_at(rebuilt, centre);
      ASSERT_EQ(a.has_value(), b.has_value()) << x << " " << y;
      if (!a) continue;
      ASSERT_LT(separation(*a, *b).in(deg), 1e-5) << x << " " << y;
    }
  }
}

TEST_P(RebuiltCamera, SeesWhatTheOneThatRenderedSaw) {
  const auto plan = pipeline::testing::plan_of_text(pipeline::testing::small_scene(
      fmt::format("{{image: \"p.####.exr\", {0}}}, {{image: \"p.####.hdr\", {0}}}", GetParam())));
  const TemporaryFolder folder;
  auto options = pipeline::testing::options_for(plan, folder.path());
  options.frames = {6};
  ASSERT_TRUE(pipeline::run_job(plan, options).ok());
  const auto& output = std::get<config::ImageOutput>(plan.job.outputs[0]);
  const auto made = pipeline::view_of_output(plan, plan.frames[5], output).camera.camera;
  const auto files = list_files(folder.path().string(), {});
  ASSERT_TRUE(files.ok());
  ASSERT_EQ(files->pairs.size(), 2u);
  for (const FilePair& file : files->pairs) {  // .hdr tells nothing itself: the manifest does
    const auto entry = nlohmann::json::parse(file.manifest_entry_b);
    const auto picture = read_picture(file.b, {}, &entry);
    ASSERT_TRUE(picture.ok());
    ASSERT_TRUE(picture->facts.view.camera) << file.name;
    expect_same_directions(*picture->facts.view.camera, made);
    ASSERT_TRUE(picture->facts.view.sun);
    EXPECT_LT(separation(*picture->facts.view.sun, plan.frames[5].sky.sun_apparent).in(deg), 1e-5);
    EXPECT_EQ(picture->facts.white_luminance, 683);
    EXPECT_EQ(picture->facts.color_space, "rec709");
  }
}

INSTANTIATE_TEST_SUITE_P(
    Projections, RebuiltCamera,
    testing::Values(
        "projection: perspective, size: 12x9, fov: 71 deg, look_at: {azimuth: 200 deg, elevation: "
        "-33 deg, roll: 17 deg}",
        "projection: perspective, size: 12x9, fov: 40 deg, look_at: {azimuth: 77 deg, elevation: "
        "90 deg}",
        "projection: fisheye, size: 11x11, fov: 180 deg, look_at: {azimuth: 10 deg, elevation: 80 "
        "deg, roll: -120 deg}",
        "projection: fisheye-equisolid, size: 11x9, fov: 360 deg",
        "projection: fisheye-stereographic, size: 9x11, fov: 220 deg, look_at: {azimuth: 300 deg}",
        "projection: mirror-ball, size: 11x11, look_at: {azimuth: 33 deg, elevation: 5 deg}",
        "projection: lat-long, size: 16x8, look_at: {azimuth: 123 deg}",
        "projection: lat-long, size: 16x8, orientation: usd",
        "projection: octahedral, size: 8x8, orientation: pbrt",
        "projection: cube, size: 4, layout: cross, look_at: {azimuth: 45 deg}",
        "projection: cube, size: 4, layout: vertical-cross",
        "projection: cube, size: 4, layout: horizontal-strip",
        "projection: cube, size: 4, layout: vertical-strip, orientation: usd"));

TEST(RebuiltCamera, FacesInFilesOfTheirOwnLookWhereTheyLook) {
  const auto plan = pipeline::testing::plan_of_text(pipeline::testing::small_scene(
      "{image: \"c.####.{face}.exr\", projection: cube, size: 4, layout: faces, orientation: "
      "unity}"));
  const TemporaryFolder folder;
  auto options = pipeline::testing::options_for(plan, folder.path());
  options.frames = {6};
  ASSERT_TRUE(pipeline::run_job(plan, options).ok());
  const auto& output = std::get<config::ImageOutput>(plan.job.outputs[0]);
  const auto view = pipeline::view_of_output(plan, plan.frames[5], output);
  const char* const names[] = {"px", "nx", "py", "ny", "pz", "nz"};
  for (size_t i = 0; i < 6; ++i) {
    const auto facts = facts_of((folder.path() / fmt::format("c.0006.{}.exr", names[i])).string());
    ASSERT_TRUE(facts.view.camera) << names[i];
    for (const double x : {0.5, 3.5}) {
      const auto seen = image::direction_at(*facts.view.camera, {x, 1.5});
      const auto made = image::direction_at(view.camera.camera, {x, 4 * view.faces[i] + 1.5});
      EXPECT_LT(separation(*seen, *made).in(deg), 1e-5) << names[i];
    }
  }
}

TEST(ReadPicture, StripsInOpenGlsOrderHaveNoCamera) {
  auto attributes = noon();
  set(attributes, "skylapse:projection", std::string("cube"));
  set(attributes, "skylapse:orientation", std::string("three"));
  attributes.push_back({"skylapse:cubeLayout", std::string("vertical-strip")});
  const TemporaryFolder folder;
  EXPECT_FALSE(facts_of(write_picture(folder, "a.exr", attributes)).view.camera);
}

}  // namespace
}  // namespace skylapse::diff
