#include "pipeline/run_job.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "output/movie_writer.h"
#include "pipeline/job_fixture.h"

using namespace skylapse;
using namespace skylapse::pipeline;
using namespace skylapse::pipeline::testing;

namespace {

const std::string kOutputs =
    "{image: \"p.####.png\", view: ACES SDR}, {image: \"l/p.####.exr\", type: half}, "
    "{movie: p.mp4, view: ACES SDR}";

nlohmann::json manifest_of(const std::filesystem::path& folder) {
  std::ifstream file(folder / "manifest.json");
  return nlohmann::json::parse(file);
}

TEST(RunJob, WritesEveryFileItPromisesAndAManifestOfThem) {
  const auto plan = plan_of_text(small_scene(kOutputs));
  const TemporaryFolder folder;
  const auto summary = run_job(plan, options_for(plan, folder.path()));
  ASSERT_TRUE(summary.ok()) << format_error(summary.error());
  EXPECT_EQ(summary->rendered, 6);
  EXPECT_TRUE(summary->complete);
  const auto files = hashes(folder.path());
  EXPECT_EQ(files.size(), 6u + 6u + 1u);
  const auto manifest = manifest_of(folder.path());
  EXPECT_EQ(manifest["frames_complete"], 6);
  EXPECT_TRUE(manifest["complete"]);
  for (const auto& frame : manifest["frames"])
    for (const auto& file : frame["files"])
      EXPECT_EQ(file["sha256"], files.at(file["path"])) << file["path"];
  EXPECT_EQ(manifest["movies"].size(), 1u);
}

TEST(RunJob, MarksFramesBelowTheHorizonAsExtrapolated) {
  const auto plan = plan_of_text(small_scene(kOutputs));
  const TemporaryFolder folder;
  ASSERT_TRUE(run_job(plan, options_for(plan, folder.path())).ok());
  const auto frames = manifest_of(folder.path())["frames"];
  EXPECT_TRUE(frames.front()["extrapolated"]);
  EXPECT_FALSE(frames.back()["extrapolated"]);
}

TEST(RunJob, ASecondRunKeepsAllFrames) {
  const auto plan = plan_of_text(small_scene(kOutputs));
  const TemporaryFolder folder;
  ASSERT_TRUE(run_job(plan, options_for(plan, folder.path())).ok());
  const auto before = hashes(folder.path());
  const auto again = run_job(plan, options_for(plan, folder.path()));
  EXPECT_EQ(again->kept, 6);
  EXPECT_EQ(again->rendered, 0);
  EXPECT_EQ(hashes(folder.path()), before);
}

TEST(RunJob, RendersDamagedAndStaleFramesAgain) {
  const auto plan = plan_of_text(small_scene(kOutputs));
  const TemporaryFolder folder;
  ASSERT_TRUE(run_job(plan, options_for(plan, folder.path())).ok());
  const auto before = hashes(folder.path());
  std::filesystem::resize_file(folder.path() / "p.0002.png", 100);
  std::filesystem::remove(folder.path() / "l/p.0003.exr");
  const auto mended = run_job(plan, options_for(plan, folder.path()));
  EXPECT_EQ(mended->rendered, 2);
  EXPECT_EQ(hashes(folder.path()), before);
  const auto other = plan_of_text(small_scene(kOutputs, "air: {turbidity: 5}"));
  const auto changed = run_job(other, options_for(other, folder.path()));
  EXPECT_EQ(changed->rendered, 6);
  EXPECT_NE(hashes(folder.path()), before);
}

TEST(RunJob, ThreadsAndShardsGiveTheSameBytes) {
  const auto plan = plan_of_text(small_scene(kOutputs));
  const TemporaryFolder one, two, shards;
  auto options = options_for(plan, one.path());
  options.jobs = 1;
  ASSERT_TRUE(run_job(plan, options).ok());
  options.output = two.path(), options.jobs = 2;
  ASSERT_TRUE(run_job(plan, options).ok());
  EXPECT_EQ(hashes(one.path()), hashes(two.path()));
  const auto all = options.frames;
  for (int part = 1; part <= 3; ++part) {
    options.output = shards.path();
    options.shard = {part, 3};
    options.frames = plan::frames_of_shard(all, options.shard);
    const auto summary = run_job(plan, options);
    ASSERT_TRUE(summary.ok());
    EXPECT_EQ(summary->complete, part == 3);
  }
  EXPECT_EQ(hashes(one.path()), hashes(shards.path()));
  EXPECT_TRUE(manifest_of(shards.path())["complete"]);
}

TEST(RunJob, AMovieNeedsNoPictureFiles) {
  const auto with = plan_of_text(small_scene(kOutputs));
  const auto without = plan_of_text(small_scene("{movie: p.mp4, view: ACES SDR}"));
  const TemporaryFolder a, b;
  ASSERT_TRUE(run_job(with, options_for(with, a.path())).ok());
  ASSERT_TRUE(run_job(without, options_for(without, b.path())).ok());
  EXPECT_EQ(hashes(a.path()).at("p.mp4"), hashes(b.path()).at("p.mp4"));
}

TEST(RunJob, PartOfTheFramesLeavesTheMovieOutAndSaysSo) {
  const auto plan = plan_of_text(small_scene(kOutputs));
  const TemporaryFolder folder;
  auto options = options_for(plan, folder.path());
  options.frames = {2, 3};
  const auto summary = run_job(plan, options);
  ASSERT_TRUE(summary.ok());
  EXPECT_EQ(summary->notes.size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "p.mp4"));
}

TEST(RunJob, TheManifestCarriesWhatFormatsWithoutMetadataCannot) {
  const auto plan = plan_of_text(small_scene("{image: \"p.####.hdr\"}"));
  const TemporaryFolder folder;
  ASSERT_TRUE(run_job(plan, options_for(plan, folder.path())).ok());
  const auto manifest = manifest_of(folder.path());
  EXPECT_EQ(manifest["sites"][0]["zone"], "Europe/Prague");
  EXPECT_NEAR(manifest["sites"][0]["latitude_deg"], 50.0755, 1e-9);
  EXPECT_NEAR(manifest["sites"][0]["height_m"], 235, 1e-9);
  EXPECT_EQ(manifest["color"]["chromaticities"].size(), 8u);
  EXPECT_EQ(manifest["color"]["white_luminance_cd_m2"], 683);
  EXPECT_EQ(manifest["outputs"][0]["format"], "hdr");
  EXPECT_EQ(manifest["cameras"][0]["width"], 96);
  EXPECT_NEAR(manifest["cameras"][0]["azimuth_deg"], 60, 1e-9);
  const auto& last = manifest["frames"].back();
  EXPECT_GT(last["exposure"]["exposure_time_s"], 0);
  EXPECT_GT(last["light"]["sky_horizontal_lux"], 100);
  EXPECT_GT(last["light"]["sun_normal_lux"], 100);
}

/// What a file says of itself under a name; nothing if it does not.
std::string said_by(const std::filesystem::path& file, const std::string& name) {
  const auto io = output::open_image_io();
  const auto image = (*io)->decode(file);
  if (!image) return "unreadable";
  for (const output::Attribute& a : image->attributes) {
    if (a.name != name) continue;
    if (const auto* text = std::get_if<std::string>(&a.value)) return *text;
    if (const auto* number = std::get_if<double>(&a.value)) return fmt::format("{:.4g}", *number);
  }
  return "";
}

TEST(RunJob, MapsSayHowTheyLieInTheirFilesAndInTheManifest) {
  const std::string outputs =
      "{image: \"m.####.exr\", projection: lat-long, size: 32x16, orientation: usd}, "
      "{image: \"b.####.exr\", projection: lat-long, size: 32x16, orientation: blender}, "
      "{image: \"c.####.{face}.exr\", projection: cube, layout: faces, size: 8, "
      "orientation: unity}, "
      "{image: \"o.####.exr\", projection: octahedral, size: 16, orientation: pbrt}, "
      "{image: \"x.####.exr\", projection: cube, layout: cross, size: 8, "
      "look_at: {azimuth: 45 deg}}, "
      "{image: \"p.####.exr\"}, "
      "{specular: \"s.####.ktx2\", size: 8, orientation: unity}";
  const auto plan = plan_of_text(small_scene(outputs));
  const TemporaryFolder folder;
  auto options = options_for(plan, folder.path());
  options.frames = {6};
  ASSERT_TRUE(run_job(plan, options).ok());
  struct Expected {
    const char *file, *projection, *orientation, *heading, *layout;
  };
  const Expected all[] = {{"m.0006.exr", "lat-long", "usd", "180", ""},
                          {"b.0006.exr", "lat-long", "blender", "90", ""},
                          {"c.0006.px.exr", "cube", "unity", "180", "faces"},
                          {"o.0006.exr", "octahedral", "pbrt", "0", ""},
                          {"x.0006.exr", "cube", "", "45", "cross"},
                          {"p.0006.exr", "perspective", "", "", ""}};
  const auto manifest = manifest_of(folder.path());
  for (size_t i = 0; i < std::size(all); ++i) {
    const Expected& e = all[i];
    const auto said = [&](const char* name) { return said_by(folder.path() / e.file, name); };
    EXPECT_EQ(said("skylapse:projection"), e.projection) << e.file;
    EXPECT_EQ(said("skylapse:orientation"), e.orientation) << e.file;
    EXPECT_EQ(said("skylapse:heading"), e.heading) << e.file;
    const auto& output = manifest["outputs"][i];
    EXPECT_EQ(output.value("orientation", ""), e.orientation) << e.file;
    if (*e.heading == '\0') continue;
    EXPECT_EQ(output["camera"]["projection"], e.projection) << e.file;
    EXPECT_EQ(fmt::format("{:.4g}", output["camera"]["azimuth_deg"].get<double>()), e.heading);
    EXPECT_EQ(output["camera"].value("layout", ""), e.layout) << e.file;
    EXPECT_GT(output["camera"]["width"], 0);
  }
  EXPECT_NEAR(manifest["outputs"][6]["camera"]["azimuth_deg"], 180, 1e-9) << "products too";
}

TEST(RunJob, FilesSayWhetherTheyHoldTheDisc) {
  struct Case {
    const char *output, *more, *content, *policy;
  };
  const Case cases[] = {{"type: half, sun: clip", "", "radiance", "clip"},
                        {"type: half, sun: split", "", "sky without disc", "split"},
                        {"type: half, content: sky", "", "sky without disc", ""},
                        {"type: float", "", "radiance", ""},
                        {"type: half, sun: clip", "sky: {model: hosek-wilkie, sun_disc: off}",
                         "sky without disc", ""}};
  for (const Case& c : cases) {
    const auto plan =
        plan_of_text(small_scene(fmt::format("{{image: \"p.####.exr\", {}}}", c.output), c.more));
    const TemporaryFolder folder;
    auto options = options_for(plan, folder.path());
    options.frames = {6};
    ASSERT_TRUE(run_job(plan, options).ok());
    const auto file = folder.path() / "p.0006.exr";
    EXPECT_EQ(said_by(file, "skylapse:content"), c.content) << c.output << c.more;
    EXPECT_EQ(said_by(file, "skylapse:sunPolicy"), c.policy) << c.output << c.more;
  }
}

TEST(RunJob, SunPoliciesAreRecordedWithWhatTheyCost) {
  const auto scene = [](const std::string& policy) {
    auto text = small_scene("{image: \"p.####.exr\", type: half, sun: " + policy + "}");
    // An hour past sunrise, looking at the sun.
    text.replace(text.find("sunrise + 30 min"), 16, "sunrise + 90 min");
    text.replace(text.find("azimuth: 60 deg"), 15, "azimuth: 62 deg");
    return text;
  };
  std::map<std::string, nlohmann::json> records;
  for (const std::string policy : {"clip", "scale", "split"}) {
    const auto plan = plan_of_text(scene(policy));
    const TemporaryFolder folder;
    auto options = options_for(plan, folder.path());
    options.frames = {long(plan.frames.size())};
    ASSERT_TRUE(run_job(plan, options).ok());
    records[policy] = manifest_of(folder.path())["frames"][0]["files"][0]["encoding"];
  }
  EXPECT_GT(records["clip"]["lost_fraction"], 0.01);
  EXPECT_GT(records["clip"]["pixels_beyond_half"], 0);
  EXPECT_LT(records["scale"]["scale"], 1);
  EXPECT_EQ(records["scale"]["lost_fraction"], 0);
  EXPECT_GT(records["split"]["lost_fraction"], 0.01);
  const auto plan = plan_of_text(scene("refuse"));
  const TemporaryFolder folder;
  const auto refused = run_job(plan, options_for(plan, folder.path()));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::invalid_input);
}

TEST(RunJob, TheManifestOfAPartListsThatPart) {
  const auto plan = plan_of_text(small_scene("{image: \"p.####.png\"}"));
  const TemporaryFolder folder;
  auto options = options_for(plan, folder.path());
  options.frames = {2, 5};
  ASSERT_TRUE(run_job(plan, options).ok());
  const auto manifest = manifest_of(folder.path());
  ASSERT_EQ(manifest["frames"].size(), 2u);
  EXPECT_EQ(manifest["frames"][1]["frame"], 5);
  EXPECT_EQ(manifest["frames_total"], 6);
  EXPECT_EQ(manifest["frames_complete"], 2);
  EXPECT_FALSE(manifest["complete"]);
}

TEST(RunJob, AStopSignalKeepsFinishedFrames) {
  const auto plan = plan_of_text(small_scene(kOutputs));
  const TemporaryFolder folder;
  auto options = options_for(plan, folder.path());
  std::atomic<int> stop = 0;
  options.stop_signal = &stop;
  options.jobs = 1;
  options.on_progress = [&](const Progress& p) {
    if (p.done == 2) stop = 2;
  };
  const auto summary = run_job(plan, options);
  ASSERT_FALSE(summary.ok());
  EXPECT_EQ(summary.error().code, ErrorCode::interrupted);
  EXPECT_GE(manifest_of(folder.path())["frames_complete"], 2);
  options.stop_signal = nullptr;
  options.on_progress = {};
  const auto resumed = run_job(plan, options);
  ASSERT_TRUE(resumed.ok());
  EXPECT_GE(resumed->kept, 2);
  EXPECT_TRUE(resumed->complete);
}

TEST(RunJob, AnUnknownViewIsFoundBeforeAnythingIsRendered) {
  const auto plan = plan_of_text(small_scene("{image: \"p.####.png\", view: ACES SDRR}"));
  const TemporaryFolder folder;
  const auto summary = run_job(plan, options_for(plan, folder.path()));
  ASSERT_FALSE(summary.ok());
  EXPECT_EQ(summary.error().code, ErrorCode::invalid_input);
  EXPECT_TRUE(hashes(folder.path()).empty());
}

TEST(RunJob, FramesInFlightAreBoundedByMemory) {
  auto plan = plan_of_text(small_scene(kOutputs));
  EXPECT_EQ(frames_in_flight(plan, 8), 9);
  plan.job.cameras[0].camera.width = 16384;
  plan.job.cameras[0].camera.height = 8192;
  EXPECT_EQ(frames_in_flight(plan, 8), 3);  // in strips
  plan.model = config::SkyModel::reference;
  EXPECT_EQ(frames_in_flight(plan, 8), 1);  // whole
}

}  // namespace
