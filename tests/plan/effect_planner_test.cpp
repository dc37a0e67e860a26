#include "plan/effect_planner.h"

#include "plan/plan_fixture.h"

using namespace skylapse;
using namespace skylapse::plan::testing;

namespace {

bool on(const plan::Plan& plan, size_t frame, plan::Effect effect) {
  for (const auto& decision : plan::decide_effects(plan, plan.frames[frame]))
    if (decision.effect == effect) {
      EXPECT_FALSE(decision.reason.empty());
      return decision.on;
    }
  ADD_FAILURE() << "no decision on " << name_of(effect);
  return false;
}

Scene at_noon(const std::string& camera) {
  Scene scene;
  scene.time = "time: {zone: Europe/Prague, date: 2026-06-21, at: [solar_noon, solar_midnight]}";
  scene.camera = "camera: {" + camera + "}";
  return scene;
}

TEST(Effects, TheDiscIsDrawnOnlyWhereTheCameraSeesIt) {
  const auto south =
      plan_of(at_noon("projection: perspective, look_at: {azimuth: 180 deg, elevation: 60 deg}, "
                      "fov: 60 deg, size: 64x36"));
  const auto north =
      plan_of(at_noon("projection: perspective, look_at: {azimuth: 0 deg, elevation: 10 deg}, fov: "
                      "60 deg, size: 64x36"));
  EXPECT_TRUE(on(south, 1, plan::Effect::sun_disc));   // noon
  EXPECT_FALSE(on(south, 0, plan::Effect::sun_disc));  // midnight: below the horizon
  EXPECT_FALSE(on(north, 1, plan::Effect::sun_disc));
}

TEST(Effects, TheGroundIsDrawnOnlyWhenAPixelLooksBelowTheHorizon) {
  const auto up =
      plan_of(at_noon("projection: perspective, look_at: {azimuth: 180 deg, elevation: 60 deg}, "
                      "fov: 40 deg, size: 64x36"));
  const auto level =
      plan_of(at_noon("projection: perspective, look_at: {azimuth: 180 deg, elevation: 0 deg}, "
                      "fov: 40 deg, size: 64x36"));
  const auto map = plan_of(at_noon("projection: lat-long, size: 64x32"));
  EXPECT_FALSE(on(up, 0, plan::Effect::ground));
  EXPECT_TRUE(on(level, 0, plan::Effect::ground));
  EXPECT_TRUE(on(map, 0, plan::Effect::ground));
}

TEST(Effects, TwilightContinuationFollowsTheSun) {
  Scene scene = at_noon("projection: lat-long, size: 64x32");
  scene.more = "sky: {model: hosek-wilkie}";
  const auto plan = plan_of(scene);
  EXPECT_TRUE(on(plan, 0, plan::Effect::twilight_continuation));
  EXPECT_FALSE(on(plan, 1, plan::Effect::twilight_continuation));
}

TEST(Effects, ASwitchedOffDiscIsOffEverywhere) {
  Scene scene = at_noon("projection: lat-long, size: 64x32");
  scene.more = "sky: {sun_disc: off}";
  EXPECT_FALSE(on(plan_of(scene), 1, plan::Effect::sun_disc));
}

}  // namespace
