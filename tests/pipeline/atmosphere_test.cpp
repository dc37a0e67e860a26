// Pictures of the computed atmosphere: on GL, with the quickest tables and few wavelengths.
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/constants.h"
#include "image/irradiance.h"
#include "pipeline/fingerprint.h"
#include "pipeline/job_fixture.h"
#include "pipeline/render_frame.h"

using namespace skylapse;
using namespace skylapse::pipeline;
using namespace skylapse::pipeline::testing;

namespace {

std::string scene(const std::string& height, const std::string& time, const std::string& camera,
                  const std::string& more = "sky: {model: bruneton, level: draft, wavelengths: 3}",
                  const std::string& outputs = "{image: \"p.####.exr\"}") {
  return "location: {name: Prague, latitude: 50.0755, longitude: 14.4378, height: " + height +
         "}\ntime: {zone: Europe/Prague, date: 2026-06-21, " + time + "}\ncamera: {" + camera +
         "}\n" + more + "\noutputs: [" + outputs + "]\n";
}

/// Tables of these tests lie in a folder of their own.
class Atmosphere : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    cache_ = new TemporaryFolder;
    ::setenv("XDG_CACHE_HOME", cache_->path().c_str(), 1);
  }
  static void TearDownTestSuite() {
    ::unsetenv("XDG_CACHE_HOME");
    delete cache_;
  }
  static TemporaryFolder* cache_;
};
TemporaryFolder* Atmosphere::cache_ = nullptr;

double luminance(const glm::dvec3& rgb) {  // Rec. 709 weights (ITU-R BT.709-6)
  return kLuminousEfficacy * glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722));
}

glm::dvec3 pixel(const RenderedFrame& frame, int x, int y) {
  const float* p = frame.scene.pixel(x, y);
  return {p[0], p[1], p[2]};
}

/// Mean over the sphere of a lat-long picture.
double mean_luminance(const image::Camera& camera, const RenderedFrame& frame) {
  double sum = 0, whole = 0;
  for (int y = 0; y < camera.height; ++y) {
    const double area = image::pixel_solid_angle(camera, 0, y).in(sr);
    for (int x = 0; x < camera.width; ++x) sum += area * luminance(pixel(frame, x, y));
    whole += area * camera.width;
  }
  return sum / whole;
}

std::vector<RenderedFrame> render_all(const plan::Plan& plan) {
  AtmosphereService atmospheres(plan, gpu::Backend::automatic);
  std::vector<RenderedFrame> frames;
  for (const plan::Frame& frame : plan.frames) {
    StageTimes times;
    auto rendered = render_frame(plan, frame, atmospheres, false, times);
    EXPECT_TRUE(rendered.ok()) << format_error(rendered.error());
    if (rendered) frames.push_back(*std::move(rendered));
  }
  return frames;
}

/// Largest second difference of log2 of the values, in stops.
double roughness(const std::vector<double>& values) {
  double worst = 0;
  for (size_t i = 2; i < values.size(); ++i)
    worst = std::max(worst, std::abs(std::log2(values[i]) - 2 * std::log2(values[i - 1]) +
                                     std::log2(values[i - 2])));
  return worst;
}

// The sun goes from 3 deg to the bottom of the night by up to 0.26 deg a frame. The disc is left
// out: where it sets the light falls as it must. The light loses up to two stops a degree; its true
// second differences reach 0.03 stops (level standard), the 20 sun nodes of the draft level bend it
// by up to 0.08. A step or a ghost of the nodes' own size would be several times that.
TEST_F(Atmosphere, DuskHasNoStepDownToTheEndOfTwilight) {
  const auto plan = plan_of_text(scene(
      "235 m", "from: sunset - 20 min, to: sunset + 225 min, step: 2 min",
      "projection: lat-long, size: 32x16", "sky: {level: draft, wavelengths: 3, sun_disc: off}"));
  EXPECT_EQ(plan.model, config::SkyModel::bruneton);
  std::vector<double> light;
  double lowest = 0;
  AtmosphereService atmospheres(plan, gpu::Backend::automatic);
  for (const plan::Frame& frame : plan.frames) {
    lowest = std::min(lowest, elevation(frame.sky.sun_true).in(deg));
    StageTimes times;
    const auto rendered = render_frame(plan, frame, atmospheres, false, times);
    ASSERT_TRUE(rendered.ok()) << format_error(rendered.error());
    light.push_back(mean_luminance(plan.job.cameras[0].camera, *rendered));
  }
  EXPECT_LT(lowest, -15);  // Prague's midsummer night goes no deeper
  for (size_t i = 1; i < light.size(); ++i) {
    EXPECT_LT(light[i], light[i - 1] * 1.0001) << "frame " << i;
    EXPECT_GT(light[i], light[i - 1] * 0.6) << "frame " << i;
  }
  EXPECT_LT(roughness(light), 0.1);
}

TEST_F(Atmosphere, ThePictureHoldsTheLightThatIsRecorded) {
  const auto plan = plan_of_text(scene("235 m", "at: ['09:00', solar_noon, '20:00', '21:30']",
                                       "projection: lat-long, size: 512x256"));
  const auto frames = render_all(plan);
  ASSERT_EQ(frames.size(), 4u);
  for (const RenderedFrame& frame : frames) {
    const glm::dvec3 rgb = image::image_irradiance(plan.job.cameras[0].camera, frame.scene);
    const double expected =
        kLuminousEfficacy * (frame.sky_irradiance_xyz.y + frame.sun_irradiance_xyz.y);
    // Three bands have colours outside Rec. 709, which the picture cuts off at 0.
    EXPECT_NEAR(luminance(rgb) / expected, 1, 0.01);
  }
  // A clear noon: 70-110 klx of sun, 5-20 klx of sky (night.md's clear sky 60 deg high: 100 klx).
  const double sun = kLuminousEfficacy * frames[1].sun_irradiance_xyz.y;
  const double sky = kLuminousEfficacy * frames[1].sky_irradiance_xyz.y;
  EXPECT_GT(sun, 60e3);
  EXPECT_LT(sun, 110e3);
  EXPECT_GT(sky, 5e3);
  EXPECT_LT(sky, 25e3);
}

TEST_F(Atmosphere, CamerasFromTheGroundToFarOutSeeFinitePictures) {
  for (const char* height :
       {"-400 m", "0 m", "3000 m", "11 km", "99.999 km", "400 km", "36000 km", "400000 km"}) {
    const auto plan = plan_of_text(
        scene(height, "at: [solar_noon, '21:20', '23:59']", "projection: lat-long, size: 48x24"));
    for (const RenderedFrame& frame : render_all(plan))
      for (const float v : frame.scene.data()) {
        ASSERT_TRUE(std::isfinite(v)) << height;
        ASSERT_GE(v, 0) << height;
      }
  }
}

TEST_F(Atmosphere, FromOrbitTheEarthIsBrightAndSpaceIsBlack) {
  const auto plan =
      plan_of_text(scene("400 km", "at: [solar_noon]", "projection: lat-long, size: 256x128",
                         "sky: {model: bruneton, level: draft, wavelengths: 3, sun_disc: off}"));
  const auto frames = render_all(plan);
  ASSERT_EQ(frames.size(), 1u);
  // The limb's air ends 2.6 deg over the horizon, which is 19.8 deg below the level.
  for (const int x : {0, 100, 200}) {
    EXPECT_EQ(luminance(pixel(frames[0], x, 20)), 0);
    EXPECT_EQ(luminance(pixel(frames[0], x, 74)), 0);
    EXPECT_GT(luminance(pixel(frames[0], x, 80)), 100);
    EXPECT_GT(luminance(pixel(frames[0], x, 120)), 3000);
  }
}

TEST_F(Atmosphere, SingleScatteringIsThePartOfTheLightThatItSays) {
  const std::string time = "at: [solar_noon]", camera = "projection: lat-long, size: 32x16";
  const std::string options = ", wavelengths: 3, sun_disc: off}";
  const auto all = render_all(
      plan_of_text(scene("235 m", time, camera, "sky: {model: bruneton, level: draft" + options)));
  const auto one = render_all(
      plan_of_text(scene("235 m", time, camera, "sky: {model: single-scattering" + options)));
  ASSERT_EQ(all.size() + one.size(), 2u);
  const double part = one[0].sky_irradiance_xyz.y / all[0].sky_irradiance_xyz.y;
  EXPECT_GT(part, 0.5);
  EXPECT_LT(part, 0.95);
}

TEST_F(Atmosphere, AirThatChangesPassesWithoutAStep) {
  const auto plan = plan_of_text(
      scene("235 m", "from: '11:00', to: '13:00', step: 5 min", "projection: lat-long, size: 32x16",
            "sky: {level: draft, wavelengths: 3, sun_disc: off}\nair: {keyframes: [{time: '11:20', "
            "aerosol_optical_depth: 0.1}, {time: '12:40', aerosol_optical_depth: 0.35}]}"));
  const auto frames = render_all(plan);
  ASSERT_EQ(frames.size(), 25u);
  // Between the keyframes, at 11:20 and 12:40: there the light bends as the air does.
  std::vector<double> light;
  for (size_t i = 5; i <= 20; ++i) light.push_back(frames[i].sky_irradiance_xyz.y);
  EXPECT_GT(frames.back().sky_irradiance_xyz.y, 1.5 * frames.front().sky_irradiance_xyz.y);
  EXPECT_LT(roughness(light), 0.02);
}

nlohmann::json manifest_of(const std::filesystem::path& folder) {
  return nlohmann::json::parse(std::ifstream(folder / "manifest.json"));
}

TEST_F(Atmosphere, ManifestSaysWhatComputedItAndAResumedRunKeepsThat) {
  const auto plan =
      plan_of_text(scene("235 m", "at: ['21:30', '22:00']", "projection: lat-long, size: 32x16",
                         "sky: {level: draft, wavelengths: 4}"));
  const TemporaryFolder folder;
  const auto options = options_for(plan, folder.path());
  const auto first = run_job(plan, options);
  ASSERT_TRUE(first.ok()) << format_error(first.error());
  const auto made = manifest_of(folder.path());
  EXPECT_EQ(made["model"], "bruneton");
  EXPECT_EQ(made["atmosphere"]["level"], "draft");
  EXPECT_EQ(made["atmosphere"]["wavelengths"], 4);
  EXPECT_EQ(made["atmosphere"]["precision"], "float");
  EXPECT_EQ(made["atmosphere"]["orders"], 0);
  EXPECT_TRUE(made["atmosphere"]["slice"].is_null());
  const auto computed = made["atmosphere"]["computed_by"];
  for (const char* key : {"backend", "vendor", "renderer", "version"})
    EXPECT_NE(computed[key], "") << key;
  ASSERT_EQ(computed["tables"].size(), 1u);
  EXPECT_FALSE(computed["tables"][0]["cached"]);
  EXPECT_GE(computed["tables"][0]["orders"], 3);
  for (const auto& frame : made["frames"]) EXPECT_EQ(frame["model"], "bruneton");

  const auto again = run_job(plan, options);
  EXPECT_EQ(again->kept, 2);
  EXPECT_EQ(manifest_of(folder.path())["atmosphere"]["computed_by"], computed);

  RunOptions anew = options;
  anew.overwrite = true;
  const auto before = hashes(folder.path());
  ASSERT_TRUE(run_job(plan, anew).ok());
  EXPECT_TRUE(manifest_of(folder.path())["atmosphere"]["computed_by"]["tables"][0]["cached"]);
  EXPECT_EQ(hashes(folder.path()), before) << "the same bytes, from tables of the cache";
}

TEST_F(Atmosphere, ResultDoesNotDependOnTheNumberOfThreads) {
  const auto plan = plan_of_text(scene("235 m", "from: '21:00', to: '22:00', step: 10 min",
                                       "projection: lat-long, size: 64x32"));
  const TemporaryFolder one, many;
  auto options = options_for(plan, one.path());
  options.jobs = 1;
  ASSERT_TRUE(run_job(plan, options).ok());
  options = options_for(plan, many.path());
  options.jobs = 4;
  ASSERT_TRUE(run_job(plan, options).ok());
  EXPECT_EQ(hashes(one.path()), hashes(many.path()));
}

TEST_F(Atmosphere, HosekWilkieOnGlIsThatOfTheCpu) {
  const auto render = [](const std::string& model) {
    auto frames = render_all(
        plan_of_text(scene("235 m", "at: ['10:00', '21:30']", "projection: lat-long, size: 64x32",
                           "sky: {model: " + model + "}")));
    EXPECT_EQ(frames.size(), 2u);
    return frames;
  };
  const auto cpu = render("hosek-wilkie"), gl = render("hosek-wilkie-gl");
  for (size_t f = 0; f < 2; ++f)
    for (size_t i = 0; i < cpu[f].scene.data().size(); ++i) {
      const float expected = cpu[f].scene.data()[i];
      ASSERT_NEAR(gl[f].scene.data()[i], expected, 1e-3 * expected + 1e-6) << f << " " << i;
    }
}

TEST_F(Atmosphere, FingerprintKnowsModelLevelWavelengthsAndMedium) {
  const auto print = [](const std::string& more) {
    const auto plan =
        plan_of_text(scene("235 m", "at: ['12:00']", "projection: lat-long, size: 32x16", more));
    return scene_fingerprint(plan, plan.frames[0]);
  };
  std::set<std::string> prints;
  for (const char* more : {"", "sky: {model: bruneton}", "sky: {model: single-scattering}",
                           "sky: {model: bruneton, level: low}",
                           "sky: {model: bruneton, wavelengths: 8}", "air: {ozone: 350 DU}",
                           "air: {ozone: 351 DU}", "sky: {model: bruneton}\nair: {turbidity: 3}"})
    EXPECT_TRUE(prints.insert(print(more)).second) << more;
}

}  // namespace
