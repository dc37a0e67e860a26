// What files shine onto level ground, held against the sky that they are of.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "image/irradiance.h"
#include "pipeline/frame_files.h"
#include "pipeline/job_fixture.h"

using namespace skylapse;
using namespace skylapse::pipeline;
using namespace skylapse::pipeline::testing;

namespace {

/// Suns from below the horizon to the zenith, at a place on the equator.
std::string scene_of_suns(const std::string& outputs, const std::string& suns,
                          const std::string& more = "air: {turbidity: 2}",
                          const std::string& size = "128x64") {
  return "location: {latitude: 0, longitude: 0, height: 0 m}\n"
         "time: {zone: UTC, date: 2026-03-20, half: afternoon, sun_elevations: [" +
         suns +
         "]}\n"
         "camera: {projection: lat-long, size: " +
         size + "}\n" + more + "\nsky: {model: hosek-wilkie}\noutputs: [" + outputs + "]\n";
}

nlohmann::json manifest_of(const std::filesystem::path& folder) {
  std::ifstream file(folder / "manifest.json");
  return nlohmann::json::parse(file);
}

/// The manifest of a job that went well.
nlohmann::json rendered(const std::string& scene, const std::filesystem::path& folder,
                        std::vector<std::string>* notes = nullptr) {
  const auto plan = plan_of_text(scene);
  const auto summary = run_job(plan, options_for(plan, folder));
  if (!summary) {
    ADD_FAILURE() << format_error(summary.error());
    return {};
  }
  if (notes != nullptr) *notes = summary->notes;
  return manifest_of(folder);
}

const std::string kHardSuns = "-6 deg, -0.4 deg, 0 deg, 0.5 deg, 2 deg, 20 deg, 89.5 deg";

TEST(LightOfFiles, LevelGroundGetsTheModelsLightFromMapsOfEverySizeAndProjection) {
  std::string outputs;
  const auto add = [&](const std::string& view) {
    outputs += fmt::format("{}{{image: \"m{}_{{sun_elevation}}.exr\", {}, compression: none}}",
                           outputs.empty() ? "" : ", ", outputs.size(), view);
  };
  for (const char* size : {"64x32", "100x50", "256x128", "1024x512"})
    add(fmt::format("projection: lat-long, size: {}", size));
  for (const int side : {16, 65})
    add(fmt::format("projection: cube, layout: vertical-strip, size: {}", side));
  add("projection: cube, layout: cross, size: 32");
  add("projection: octahedral, size: 64");
  add("projection: mirror-ball, size: 96");
  for (const char* air : {"air: {turbidity: 2}", "air: {turbidity: 10}"}) {
    const TemporaryFolder folder;
    const auto manifest = rendered(scene_of_suns(outputs, kHardSuns, air), folder.path());
    ASSERT_EQ(manifest["frames"].size(), 7u);
    for (const auto& frame : manifest["frames"]) {
      ASSERT_EQ(frame["files"].size(), 9u);
      for (const auto& file : frame["files"])
        EXPECT_LT(std::abs(file["encoding"]["error_percent"].get<double>()), 0.5)
            << air << " " << file["path"] << " sun " << frame["sun"]["elevation_deg"];
    }
  }
}

TEST(LightOfFiles, EveryPolicyButClipKeepsTheLightInHalfExrAndHdr) {
  const TemporaryFolder folder;
  std::string outputs = "{image: \"plain_{sun_elevation}.hdr\"}";
  for (const char* policy : {"float", "split", "scale"})
    outputs += fmt::format(
        ", {{image: \"h{0}_{{sun_elevation}}.exr\", type: half, sun: {0}}}, "
        "{{image: \"r{0}_{{sun_elevation}}.hdr\", sun: {0}}}",
        policy);
  outputs += ", {image: \"sky_{sun_elevation}.hdr\", content: sky}";
  const auto manifest =
      rendered(scene_of_suns(outputs, "1.5 deg, 30 deg", "", "1024x512"), folder.path());
  for (const auto& frame : manifest["frames"])
    for (const auto& file : frame["files"]) {
      const auto& encoding = file["encoding"];
      EXPECT_LT(std::abs(encoding["error_percent"].get<double>()), 0.5) << file["path"];
      const std::string path = file["path"];
      if (path.starts_with("hfloat")) {
        EXPECT_EQ(encoding["stored_bits"], 32);
      }
      if (path.starts_with("hscale")) {
        EXPECT_LT(encoding["scale"], 1.0);
      }
      EXPECT_EQ(encoding.contains("sun_apart_horizontal_lux"), path.find("split") != path.npos);
    }
}

TEST(LightOfFiles, WhatClipLosesIsRecordedAndTold) {
  const TemporaryFolder folder;
  std::vector<std::string> notes;
  const auto manifest = rendered(scene_of_suns("{image: \"c_{sun_elevation}.exr\", type: half}",
                                               "-6 deg, 30 deg", "", "1024x512"),
                                 folder.path(), &notes);
  const auto night = manifest["frames"][0]["files"][0]["encoding"];
  const auto day = manifest["frames"][1]["files"][0]["encoding"];
  EXPECT_LT(day["error_percent"], -50.0);
  EXPECT_GT(day["pixels_beyond_half"], 0);
  EXPECT_NEAR(night["error_percent"].get<double>(), 0.0, 0.05);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("clip cut light off in 1 file,"), std::string::npos) << notes[0];
}

TEST(LightOfFiles, HalfFilesOfMoonlessNightsKeepTheirLightOrSaySo) {
  const TemporaryFolder folder;
  std::vector<std::string> notes;
  std::string scene = scene_of_suns(
      "{image: s.exr, type: half, sun: scale}, {image: f.exr, type: half, sun: float}, {image: "
      "c.exr, type: half, sun: clip}",
      "-18.3 deg");
  const std::string fitted = "hosek-wilkie";  // which has no nights
  scene.replace(scene.find(fitted), fitted.size(), "bruneton, level: draft");
  const auto manifest = rendered(scene, folder.path(), &notes);
  const auto& files = manifest["frames"][0]["files"];
  ASSERT_GT(files[0]["encoding"]["true_horizontal_lux"], 0.0);
  EXPECT_GT(files[0]["encoding"]["scale"], 1.0);
  EXPECT_EQ(files[1]["encoding"]["stored_bits"], 32);
  for (int i = 0; i < 2; ++i)
    EXPECT_LT(std::abs(files[i]["encoding"]["error_percent"].get<double>()), 0.5) << i;
  EXPECT_LT(files[2]["encoding"]["error_percent"], -0.5);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("off in 1 file,"), std::string::npos) << notes[0];
}

TEST(LightOfFiles, AFileHoldsTheLightThatItsRecordClaims) {
  const TemporaryFolder folder;
  const auto manifest =
      rendered(scene_of_suns("{image: f.exr, type: half, sun: scale}", "30 deg"), folder.path());
  const auto io = output::open_image_io();
  const auto file = (*io)->decode(folder / "f.exr");
  ASSERT_TRUE(file.ok());
  image::Camera camera;
  camera.projection = image::Projection::lat_long;
  camera.width = 128, camera.height = 64;
  const glm::dvec3 rgb = image::image_irradiance(camera, file->pixels);
  const auto& encoding = manifest["frames"][0]["files"][0]["encoding"];
  // Luminance of linear Rec.709 (ITU-R BT.709-6), four digits; 683 lm/W.
  const double lux =
      683 * (0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z) / encoding["scale"].get<double>();
  EXPECT_NEAR(lux / encoding["horizontal_lux"].get<double>(), 1, 2e-4);
}

TEST(LightOfFiles, PicturesThatDoNotShowTheWholeSkyAreNotWeighed) {
  const TemporaryFolder folder;
  const auto plan = plan_of_text(small_scene("{image: \"p.####.exr\"}"));
  ASSERT_TRUE(run_job(plan, options_for(plan, folder.path())).ok());
  const auto manifest = manifest_of(folder.path());
  EXPECT_FALSE(manifest["frames"][0]["files"][0].contains("encoding"));
}

/// Writes all image outputs of a frame in strips of some pixels.
void write_in_strips(const plan::Plan& plan, const std::filesystem::path& folder, size_t pixels) {
  const auto io = output::open_image_io();
  ASSERT_TRUE(io.ok());
  const auto displays = Displays::make(**io, plan.job);
  AtmosphereService atmospheres(plan, gpu::Backend::automatic, [](double) { return true; });
  StageTimes times;
  const auto& frame = plan.frames.front();
  const auto light = light_of_frame(plan, frame, atmospheres, times);
  ASSERT_TRUE(light.ok());
  const FrameSource source{**io, plan, frame, *light, *displays, folder, {}};
  std::vector<size_t> outputs(plan.job.outputs.size());
  std::iota(outputs.begin(), outputs.end(), size_t{0});
  for (const ViewGroup& group : group_by_view(plan, frame, outputs))
    ASSERT_TRUE(write_view(
        source, group, [](size_t) { return "print"; }, times,
        [](const LedgerEntry&) -> Status { return Done{}; }, times, pixels));
}

TEST(LightOfFiles, StripsGiveTheBytesOfWholePictures) {
  const std::string lat_long = "projection: lat-long, size: 600x300";
  const auto plan = plan_of_text(scene_of_suns(
      "{image: a.exr, " + lat_long + "}, {image: b.exr, type: half, sun: scale, " + lat_long +
          "}, {image: c.exr, type: half, sun: split, " + lat_long +
          "}, {image: d.exr, type: half, sun: float, " + lat_long + "}, {image: e.hdr, " +
          lat_long + "}, {image: f.png, view: ACES SDR, " + lat_long +
          "}, {image: g.tif, type: float, content: sky, " + lat_long +
          "}, {image: \"h_{face}.exr\", projection: cube, layout: faces, size: 130, orientation: "
          "three}, {image: i.exr, projection: cube, layout: vertical-strip, size: 130, "
          "orientation: unity}, {image: j.exr, projection: cube, layout: horizontal-strip, size: "
          "130, orientation: unity}",
      "12 deg"));
  const TemporaryFolder whole, strips;
  write_in_strips(plan, whole.path(), kStripPixels);
  write_in_strips(plan, strips.path(), 7000);
  const auto expected = hashes(whole.path());
  EXPECT_EQ(expected.size(), 9u + 6u);
  EXPECT_EQ(hashes(strips.path()), expected);
}

TEST(LightOfFiles, BytesOfAFileDoNotDependOnItsNeighbours) {
  const std::string cube = "projection: cube, size: 64";
  const std::string apart = "{image: \"f_{face}.exr\", layout: faces, " + cube + "}";
  const std::string strip = "{image: v.exr, layout: vertical-strip, " + cube + "}";
  std::vector<std::map<std::string, std::string>> found;
  for (const std::string& outputs : {apart + ", " + strip, strip + ", " + apart, apart, strip}) {
    const TemporaryFolder folder;
    write_in_strips(plan_of_text(scene_of_suns(outputs, "12 deg")), folder.path(), kStripPixels);
    found.push_back(hashes(folder.path()));
  }
  EXPECT_EQ(found[0], found[1]);
  for (const size_t alone : {2, 3})
    for (const auto& [file, hash] : found[alone]) EXPECT_EQ(found[0].at(file), hash) << file;
}

TEST(LightOfFiles, FacesApartAreThoseOfTheStripInTheOrderOfTheOrientation) {
  const auto plan = plan_of_text(scene_of_suns(
      "{image: \"f_{face}.exr\", projection: cube, layout: faces, size: 130, orientation: three}, "
      "{image: v.exr, projection: cube, layout: vertical-strip, size: 130, orientation: three}, "
      "{image: h.exr, projection: cube, layout: horizontal-strip, size: 130, orientation: three}",
      "12 deg"));
  const TemporaryFolder folder;
  write_in_strips(plan, folder.path(), kStripPixels);
  const auto io = output::open_image_io();
  const auto vertical = (*io)->decode(folder / "v.exr");
  const auto horizontal = (*io)->decode(folder / "h.exr");
  ASSERT_TRUE(vertical.ok() && horizontal.ok());
  int k = 0;
  for (const char* face : {"px", "nx", "py", "ny", "pz", "nz"}) {
    const auto apart = (*io)->decode(folder / fmt::format("f_{}.exr", face));
    ASSERT_TRUE(apart.ok());
    for (int y = 0; y < 130; y += 3)
      for (int x = 0; x < 130; x += 3)
        for (int c = 0; c < 3; ++c) {
          ASSERT_EQ(apart->pixels.pixel(x, y)[c], vertical->pixels.pixel(x, 130 * k + y)[c]);
          ASSERT_EQ(apart->pixels.pixel(x, y)[c], horizontal->pixels.pixel(130 * k + x, y)[c]);
        }
    ++k;
  }
}

const std::string kLibrary =
    "{image: \"{sun_elevation}/m.exr\", projection: lat-long, size: 128x64}, "
    "{image: \"{sun_elevation}/h.exr\", type: half, sun: scale}, {image: "
    "\"{sun_elevation}/r.hdr\"}, "
    "{image: \"{sun_elevation}/c_{face}.exr\", projection: cube, size: 32, layout: faces}, "
    "{image: \"{sun_elevation}/t.ktx2\", projection: cube, size: 32, type: half, sun: scale}, "
    "{harmonics: \"{sun_elevation}/sh.json\"}, {sun: \"{sun_elevation}/sun.json\"}, "
    "{irradiance: \"{sun_elevation}/i.hdr\", projection: lat-long, size: 64x32}";

TEST(LightOfFiles, ALibraryIsTheSameInOneOrEightShardsAndTakenUpAgain) {
  const auto plan =
      plan_of_text(scene_of_suns(kLibrary, "-3 deg, 1 deg, 3 deg, 10 deg, 20 deg, 30 deg, 40 deg"));
  const TemporaryFolder one, shards, again;
  auto options = options_for(plan, one.path());
  const auto first = run_job(plan, options);
  ASSERT_TRUE(first.ok()) << format_error(first.error());
  const auto expected = hashes(one.path());
  EXPECT_EQ(expected.size(), 7u * 13u);
  const auto all = options.frames;
  options.output = shards.path();
  for (const int part : {3, 1, 2, 8, 7, 5, 6, 4}) {
    options.shard = {part, 8};
    options.frames = plan::frames_of_shard(all, options.shard);
    ASSERT_TRUE(run_job(plan, options).ok());
  }
  EXPECT_EQ(hashes(shards.path()), expected);
  EXPECT_TRUE(manifest_of(shards.path())["complete"]);
  EXPECT_EQ(manifest_of(shards.path())["frames"].size(), 7u);

  options = options_for(plan, again.path());
  std::atomic<int> stop = 0;  // as a signal would
  options.stop_signal = &stop;
  options.on_progress = [&](const Progress& p) { stop = p.done >= 3 ? 1 : 0; };
  EXPECT_EQ(run_job(plan, options).error().code, ErrorCode::interrupted);
  EXPECT_LT(hashes(again.path()).size(), expected.size());
  options.stop_signal = nullptr;
  const auto rest = run_job(plan, options);
  ASSERT_TRUE(rest.ok());
  EXPECT_GT(rest->kept, 0);
  EXPECT_EQ(hashes(again.path()), expected);
}

}  // namespace
