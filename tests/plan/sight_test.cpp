// What any output shows of a frame counts for its plan.
#include "plan/sight.h"

#include "plan/cost_model.h"
#include "plan/effect_planner.h"
#include "plan/plan_fixture.h"

using namespace skylapse;
using namespace skylapse::plan::testing;

namespace {

const std::string kZenith =
    "camera: {projection: perspective, look_at: zenith, fov: 20 deg, size: 64x36}";

Scene scene_with(const std::string& outputs, const std::string& more = "") {
  Scene scene;
  scene.more = "sky: {model: bruneton, level: draft, wavelengths: 3" + more + "}";
  scene.camera = kZenith;
  scene.outputs = "outputs: [" + outputs + "]";
  return scene;
}

bool is_on(const plan::Plan& plan, plan::Effect effect) {
  return plan::decide_effect(plan, plan.frames[0], effect)->on;
}

TEST(Sight, ThePictureOfTheZenithNeedsNeitherGroundNorDisc) {
  const auto plan = plan_of(scene_with("{image: f.####.png}"));
  EXPECT_FALSE(is_on(plan, plan::Effect::ground));
  EXPECT_FALSE(is_on(plan, plan::Effect::sun_disc));
  EXPECT_NE(plan.sights[0].only_picture(), nullptr);
}

TEST(Sight, AMapOfItsOwnNeedsWhatItShows) {
  for (const char* projection : {"lat-long", "cube", "octahedral", "mirror-ball"}) {
    const auto plan = plan_of(scene_with(
        "{image: f.####.png}, {image: m.####.exr, projection: " + std::string(projection) + "}"));
    EXPECT_TRUE(is_on(plan, plan::Effect::ground)) << projection;
    EXPECT_TRUE(is_on(plan, plan::Effect::sun_disc)) << projection;
    EXPECT_EQ(plan.sights[0].only_picture(), nullptr) << projection;
    EXPECT_LE(plan.views[0].lowest, -89 * deg) << projection;
  }
}

TEST(Sight, ProductsThatGatherLightSeeEverything) {
  for (const char* product :
       {"specular: a.####.ktx2", "irradiance: a.####.exr", "harmonics: a.####.json"}) {
    const auto plan = plan_of(scene_with("{image: f.####.png}, {" + std::string(product) + "}"));
    EXPECT_TRUE(is_on(plan, plan::Effect::ground)) << product;
    EXPECT_TRUE(is_on(plan, plan::Effect::sun_disc)) << product;
    EXPECT_EQ(plan.sights[0].only_picture(), nullptr) << product;
  }
  // The sun's own light is computed, not looked at.
  const auto sun = plan_of(scene_with("{image: f.####.png}, {sun: s.####.json}"));
  EXPECT_FALSE(is_on(sun, plan::Effect::ground));
  EXPECT_NE(sun.sights[0].only_picture(), nullptr);
}

TEST(Sight, ACameraThatNoOutputShowsDoesNotCount) {
  Scene scene = scene_with(
      "{image: f.####.exr, projection: perspective, look_at: zenith, fov: 20 "
      "deg, size: 64x36}");
  scene.camera = "camera: {projection: lat-long, size: 64x32}";
  EXPECT_FALSE(is_on(plan_of(scene), plan::Effect::ground));
}

TEST(Sight, PixelsAreThoseOfAllPictures) {
  const auto small = plan_of(scene_with("{image: f.####.png}"));
  const auto both = plan_of(scene_with("{image: f.####.png}, {image: l.####.png, size: 640x360}"));
  EXPECT_LT(both.pixels[0].smallest, small.pixels[0].smallest);
  EXPECT_EQ(both.pixels[0].largest, small.pixels[0].largest);
}

TEST(Sight, MapsOfOneSkyAreOneSky) {
  const auto plan = plan_of(scene_with(
      "{image: a.####.exr, projection: lat-long}, {image: b.####.exr, projection: cube}, {image: "
      "c.####.exr, projection: octahedral}, {harmonics: h.####.json}"));
  EXPECT_EQ(plan.sights[0].pictures.size(), 3u);
  EXPECT_EQ(plan.sights[0].skies().size(), 1u);
}

/// The zenith is easier than the whole sky; a promise covers what is written.
TEST(Sight, APromiseCoversEveryViewOfAFrame) {
  const auto promised = [](const std::string& outputs) {
    Scene scene;
    scene.more = "sky: {accuracy: 10 %}";
    scene.camera = kZenith;
    scene.outputs = "outputs: [" + outputs + "]";
    return plan_of(scene).promise->taken;
  };
  const auto zenith = promised("{image: f.####.png}");
  const auto whole = promised("{image: f.####.png}, {harmonics: h.####.json}");
  EXPECT_TRUE(whole.name != zenith.name || whole.error > zenith.error)
      << whole.name << " " << whole.error << " " << zenith.error;
}

TEST(Sight, EveryOutputHasItsCost) {
  const auto plan = plan_of(scene_with(
      "{image: f.####.exr}, {image: g.####.exr, size: 640x360}, {specular: s.####.ktx2, size: 16}, "
      "{specular: t.####.ktx2, size: 256}, {sun: s.####.json}"));
  const auto cost = plan::estimate_cost(plan, {1});
  ASSERT_EQ(cost.outputs.size(), 5u);
  EXPECT_NEAR(cost.outputs[1].bytes, 100 * cost.outputs[0].bytes, 1);
  EXPECT_NEAR(cost.outputs[3].bytes, 256 * cost.outputs[2].bytes, 1);
  double bytes = 0;
  for (const auto& output : cost.outputs) bytes += output.bytes;
  EXPECT_NEAR(cost.bytes, bytes, 1);
  // A half cube with its mips: 8 bytes a pixel, and a third more.
  EXPECT_NEAR(cost.outputs[3].bytes, 6 * 256 * 256 * 8 * 4 / 3., 1);
}

}  // namespace
