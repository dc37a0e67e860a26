#include "plan/effect_planner.h"

#include "plan/cost_model.h"
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

plan::EffectDecision decision_of(const plan::Plan& plan, plan::Effect effect) {
  const auto decision = plan::decide_effect(plan, plan.frames.back(), effect);
  EXPECT_TRUE(decision) << name_of(effect);
  return decision.value_or(plan::EffectDecision{effect, false, "", {}, 0});
}

Scene computed(const std::string& effects, const std::string& more = "") {
  Scene scene = at_noon("projection: lat-long, size: 64x32");
  scene.more = "sky: {model: bruneton, effects: " + effects + "}" + more;
  return scene;
}

TEST(Effects, AllTakesWhatIsPossibleAndAListItsOwnAndNoOthers) {
  for (const auto& d :
       plan::decide_effects(plan_of(computed("all")), plan_of(computed("all")).frames[1]))
    EXPECT_TRUE(d.on) << name_of(d.effect);
  const auto plan = plan_of(computed("[ozone, ground]"));
  for (const auto& d : plan::decide_effects(plan, plan.frames[1]))
    EXPECT_EQ(d.on, d.effect == plan::Effect::ozone || d.effect == plan::Effect::ground)
        << name_of(d.effect);
  EXPECT_FALSE(plan.air.aerosol);
  EXPECT_TRUE(plan.air.ozone);
}

TEST(Effects, KeysThatSwitchOffWinOverAll) {
  Scene scene = at_noon("projection: lat-long, size: 64x32");
  scene.more = "sky: {model: bruneton, effects: all, sun_disc: off}\nair: {refraction: off}";
  const auto plan = plan_of(scene);
  EXPECT_FALSE(decision_of(plan, plan::Effect::sun_disc).on);
  EXPECT_FALSE(decision_of(plan, plan::Effect::refraction).on);
}

TEST(Effects, EveryDecisionOfThePlannerIsBounded) {
  for (const char* sky : {"bruneton", "single-scattering", "hosek-wilkie"}) {
    Scene scene = at_noon(
        "projection: perspective, look_at: {azimuth: 0 deg, elevation: 60 deg}, "
        "fov: 20 deg, size: 64x32");
    scene.more = std::string("sky: {model: ") + sky + "}";
    const auto plan = plan_of(scene);
    for (const auto& d : plan::decide_effects(plan, plan.frames[1])) {
      EXPECT_FALSE(d.reason.empty());
      EXPECT_GE(d.core_seconds, 0);
      const bool by_model = d.effect == plan::Effect::multiple_scattering;
      if (!d.on && !by_model) {
        EXPECT_TRUE(d.error_bound) << sky << " " << name_of(d.effect);
      }
    }
  }
}

TEST(Effects, AirWithoutOzoneOrHazeIsComputedWithoutThem) {
  const auto clean = plan_of(computed("auto", "\nair: {aerosol_optical_depth: 0, ozone: 0 DU}"));
  EXPECT_FALSE(decision_of(clean, plan::Effect::ozone).on);
  EXPECT_FALSE(decision_of(clean, plan::Effect::aerosol).on);
  EXPECT_EQ(decision_of(clean, plan::Effect::ozone).error_bound, 0);
  const auto usual = plan_of(computed("auto"));
  EXPECT_TRUE(decision_of(usual, plan::Effect::ozone).on);
  EXPECT_TRUE(decision_of(usual, plan::Effect::aerosol).on);
}

TEST(Effects, ACameraInSpaceThatSeesNoAirNeedsNoTables) {
  Scene scene = computed("auto");
  scene.location = "location: {name: orbit, latitude: 10, longitude: 20, height: 400 km}";
  scene.camera =
      "camera: {projection: perspective, look_at: {azimuth: 0 deg, elevation: 45 deg}, fov: 40 "
      "deg, size: 64x36}";
  const auto plan = plan_of(scene);
  EXPECT_FALSE(decision_of(plan, plan::Effect::multiple_scattering).on);
  EXPECT_EQ(plan::estimate_cost(plan, {1, 2}).table_sets, 0);
}

TEST(Effects, APictureWithinTheSunsDiscHasTheDisc) {
  // Neither the disc's centre nor its limb is in the picture of a telescope that looks between.
  const auto probe = plan_of(at_noon("projection: lat-long, size: 64x32"));
  const auto& sun = probe.frames[1].sky.sun_apparent;
  image::Camera camera;
  camera.width = camera.height = 32;
  camera.field_of_view = 0.05 * deg;
  camera.camera_to_enu = image::look_at(azimuth(sun), elevation(sun) + 0.13 * deg, {});
  EXPECT_TRUE(plan::sun_disc_in_view(plan::Sight{{camera}}, probe.frames[1].sky));
}

}  // namespace
