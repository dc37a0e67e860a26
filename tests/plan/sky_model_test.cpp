// Which model a job gets, and what follows from it for its frames.
#include "plan/sky_model.h"

#include <cmath>

#include "astro/refraction.h"
#include "plan/cost_model.h"
#include "plan/effect_planner.h"
#include "plan/exposure_plan.h"
#include "plan/plan_fixture.h"

using namespace skylapse;
using namespace skylapse::plan::testing;
using config::SkyModel;

namespace {

std::string at_height(const std::string& height) {
  return "location: {name: Prague, latitude: 50.0755, longitude: 14.4378, height: " + height + "}";
}

Scene through_sunset(const std::string& more = "") {
  Scene scene;
  scene.time =
      "time: {zone: Europe/Prague, date: 2026-06-21, from: sunset - 20 min, to: sunset + 20 min, "
      "step: 10 min}";
  scene.more = more;
  return scene;
}

bool says(const plan::Plan& plan, const std::string& text) {
  return plan.model_reason.find(text) != std::string::npos;
}

TEST(SkyModel, DaylightOnTheGroundIsHosekWilkies) {
  const auto plan = plan_of(Scene{});
  EXPECT_EQ(plan.model, SkyModel::hosek_wilkie);
  EXPECT_TRUE(says(plan, "the sun is up in every frame")) << plan.model_reason;
  for (const auto& frame : plan.frames) EXPECT_EQ(frame.horizon, Angle{});
}

TEST(SkyModel, OneSunBelowTheHorizonGivesTheWholeJobTheAtmosphere) {
  const auto plan = plan_of(through_sunset());
  EXPECT_EQ(plan.model, SkyModel::bruneton);
  EXPECT_TRUE(says(plan, "2026-06-21T21:15")) << "the first such time: " << plan.model_reason;
  for (const auto& frame : plan.frames) EXPECT_FALSE(frame.sun.extrapolated);
}

TEST(SkyModel, HighSitesGiveTheAtmosphereAndLowOnesDoNot) {
  Scene scene;
  scene.location = at_height("1000 m");
  EXPECT_EQ(plan_of(scene).model, SkyModel::hosek_wilkie);
  scene.location = at_height("1001 m");
  const auto plan = plan_of(scene);
  EXPECT_EQ(plan.model, SkyModel::bruneton);
  EXPECT_TRUE(says(plan, "site 'Prague' is 1001 m high")) << plan.model_reason;
}

TEST(SkyModel, SitesBelowTheGroundOfTheAtmosphereAreSeenFromItAndThePlanSaysSo) {
  Scene scene = through_sunset();
  EXPECT_TRUE(plan_of(scene).notes.empty());
  scene.location = at_height("-100 m");
  const auto plan = plan_of(scene);
  for (const auto& frame : plan.frames) EXPECT_EQ(frame.camera_height, Length{});
  ASSERT_EQ(plan.notes.size(), 1u);
  EXPECT_NE(plan.notes[0].find("'Prague' at -100 m"), std::string::npos) << plan.notes[0];
}

TEST(SkyModel, AKeyThatOnlyAnAtmosphereKnowsGivesTheAtmosphere) {
  Scene scene;
  scene.more = "air: {ozone: 350 DU}";
  const auto plan = plan_of(scene);
  EXPECT_EQ(plan.model, SkyModel::bruneton);
  EXPECT_TRUE(says(plan, "ozone")) << plan.model_reason;
  EXPECT_TRUE(says(plan, "scene.yaml:3")) << plan.model_reason;
}

TEST(SkyModel, AWrittenModelIsTaken) {
  const auto hosek_wilkie = plan_of(through_sunset("sky: {model: hosek-wilkie}"));
  EXPECT_EQ(hosek_wilkie.model, SkyModel::hosek_wilkie);
  EXPECT_TRUE(hosek_wilkie.frames.back().sun.extrapolated);
  Scene scene;
  for (const auto& [name, model] : {std::pair("bruneton", SkyModel::bruneton),
                                    std::pair("single-scattering", SkyModel::single_scattering)}) {
    scene.more = "sky: {model: " + std::string(name) + "}";
    const auto plan = plan_of(scene);
    EXPECT_EQ(plan.model, model);
    EXPECT_EQ(plan::name_of(plan.model), name);
  }
}

TEST(SkyModel, CamerasStandOnTheGroundOrAboveIt) {
  // The dip is acos(R / (R + h)).
  for (const auto& [height, km_up] :
       {std::pair("-400 m", 0.0), std::pair("0 m", 0.0), std::pair("3000 m", 3.0),
        std::pair("11 km", 11.0), std::pair("400 km", 400.0), std::pair("36000 km", 36000.0)}) {
    Scene scene;
    scene.location = at_height(height);
    scene.more = "sky: {model: bruneton}";
    const auto plan = plan_of(scene);
    EXPECT_NEAR(plan.frames[0].camera_height.in(km), km_up, 1e-9);
    EXPECT_NEAR(plan.frames[0].horizon.in(rad), -std::acos(6371 / (6371 + km_up)), 1e-7) << height;
  }
}

TEST(SkyModel, ThinAirRefractsLessUnlessItsPressureIsGiven) {
  Scene scene;
  scene.time = "time: {zone: Europe/Prague, date: 2026-06-21, at: [sunset]}";
  scene.more = "sky: {model: bruneton}";
  const auto lift = [&](const std::string& height, const std::string& more) {
    scene.location = at_height(height);
    scene.more = more;
    const auto plan = plan_of(scene);
    return separation(plan.frames[0].sky.sun_true, plan.frames[0].sky.sun_apparent).in(arcmin);
  };
  const std::string bruneton = "sky: {model: bruneton}";
  const double ground = lift("0 m", bruneton);
  EXPECT_GT(ground, 25);
  EXPECT_NEAR(lift("11 km", bruneton) / ground, std::exp(-11 / 8.4), 0.05);
  EXPECT_LT(lift("400 km", bruneton), 1e-9);
  EXPECT_GT(lift("11 km", bruneton + "\nair: {pressure: 1000 hPa}"), 20);
}

// The straight-ray model's sun stands where it is seen, and comes down without a step.
TEST(SunForAtmosphere, StandsWhereItIsSeenAndSinksSteadily) {
  const astro::RefractionConditions air;
  double last = 91;
  for (double el = 90; el >= -90; el -= 0.01) {
    astro::SkyState sky;
    sky.sun_true = enu_direction(200 * deg, el * deg);
    sky.sun_apparent = astro::lift_by_refraction(sky.sun_true, air);
    sky.sun_distance = 1 * astronomical_unit;
    const auto sun = plan::sun_for_atmosphere(sky);
    EXPECT_EQ(sun.direction.vec(), sky.sun_apparent.vec());
    EXPECT_EQ(sun.twilight_level, 1);
    EXPECT_FALSE(sun.extrapolated);
    const double now = sun.elevation.in(deg);
    EXPECT_LT(now, last);
    if (el < 89) {
      EXPECT_NEAR(last - now, 0.01, 0.004) << el;
    }
    if (el < -6) {
      EXPECT_NEAR(now, el, 1e-9);
    }
    last = now;
  }
}

bool decides_on(const plan::Plan& plan, plan::Effect effect) {
  for (const auto& decision : plan::decide_effects(plan, plan.frames[0]))
    if (decision.effect == effect) return true;
  return false;
}

TEST(SkyModel, EffectsAreThoseOfTheModel) {
  const auto fitted = plan_of(through_sunset("sky: {model: hosek-wilkie}"));
  const auto computed = plan_of(through_sunset());
  EXPECT_TRUE(decides_on(fitted, plan::Effect::twilight_continuation));
  EXPECT_FALSE(decides_on(fitted, plan::Effect::multiple_scattering));
  EXPECT_FALSE(decides_on(computed, plan::Effect::twilight_continuation));
  EXPECT_TRUE(decides_on(computed, plan::Effect::multiple_scattering));
}

TEST(SkyModel, LeavingOutMultipleScatteringHasNoBound) {
  const auto plan = plan_of(through_sunset("sky: {model: single-scattering}"));
  for (const auto& decision : plan::decide_effects(plan, plan.frames[0])) {
    if (decision.effect != plan::Effect::multiple_scattering) continue;
    EXPECT_FALSE(decision.on);
    EXPECT_FALSE(decision.error_bound);
  }
}

TEST(SkyModel, AHighCameraSeesTheDiscBelowElevationZero) {
  Scene scene = through_sunset();
  scene.location = at_height("11 km");
  scene.camera = "camera: {projection: lat-long, size: 64x32}";
  const auto plan = plan_of(scene);
  const auto& frame = plan.frames[3];
  EXPECT_LT(elevation(frame.sky.sun_apparent) + frame.sky.sun_radius, 0 * deg);
  EXPECT_TRUE(plan::decide_effects(plan, frame)[0].on);
}

TEST(SkyModel, SunCurveIsSmoothFromAnyHeight) {
  for (const char* height : {"235 m", "3000 m", "11 km", "400 km"}) {
    Scene scene = through_sunset();
    scene.location = at_height(height);
    scene.time =
        "time: {zone: Europe/Prague, date: 2026-06-21, from: 12:00, to: 24:00, step: 2 min}";
    const auto plan = plan_of(scene);
    EXPECT_EQ(plan.model, SkyModel::bruneton);
    // The sun sinks by at most 0.35 deg in 2 minutes; twilight loses up to 1.7 stops a degree.
    for (size_t i = 1; i < plan.frames.size(); ++i)
      EXPECT_LT(std::abs(plan.frames[i].ev - plan.frames[i - 1].ev), 0.65) << height;
  }
}

TEST(SkyModel, TheMeterReadsTheAtmosphereToo) {
  Scene scene;
  scene.time = "time: {zone: Europe/Prague, date: 2026-06-21, at: [solar_noon, '22:10']}";
  scene.more = "sky: {model: bruneton}\nexposure: {mode: metered, rate_limit: 100}";
  const auto plan = plan_of(scene);
  plan::SkyMeter meter(plan);
  // A clear noon's sky as in NoonSkyLuminanceIsThatOfAClearSky; the sun at -7.2 deg leaves about
  // 1 lx (USNO Circular 171).
  const double noon = meter.read(plan.frames[0])->in(cd_per_m2);
  const double dusk = meter.read(plan.frames[1])->in(cd_per_m2);
  EXPECT_GT(noon, 2500);
  EXPECT_LT(noon, 8000);
  EXPECT_GT(dusk, 0.1);
  EXPECT_LT(dusk, 1);
  EXPECT_GT(plan.frames[0].ev - plan.frames[1].ev, 11);
}

TEST(SkyModel, CostCountsTheTablesOfEachAir) {
  Scene scene;
  scene.more = "sky: {model: bruneton}\nair: {turbidity: [2, 3, 4]}";
  const auto many = plan_of(scene);
  std::vector<long> frames;
  for (const auto& frame : many.frames) frames.push_back(frame.index);
  const auto cost = plan::estimate_cost(many, frames);
  EXPECT_EQ(cost.table_sets, 3);
  EXPECT_GT(cost.table_core_seconds, 1);
  EXPECT_GT(cost.table_bytes, 1e7);
  EXPECT_EQ(plan::estimate_cost(plan_of(Scene{}), {1}).table_sets, 0);
}

TEST(SkyModel, AllEffectsCostMoreThanThoseCalledFor) {
  Scene some, all;
  some.more = "sky: {model: bruneton}";
  all.more = "sky: {model: bruneton, effects: all}";
  const auto a = plan::estimate_cost(plan_of(some), {1});
  const auto b = plan::estimate_cost(plan_of(all), {1});
  EXPECT_GT(b.table_core_seconds, 2 * a.table_core_seconds);
  EXPECT_GT(b.table_bytes, a.table_bytes);
  EXPECT_GT(b.core_seconds, 2 * a.core_seconds);
}

TEST(SkyModel, AirThatChangesCostsAMixtureAFrame) {
  Scene still, changing;
  still.more = "sky: {model: bruneton}";
  changing.more = still.more +
                  "\nair: {turbidity: 3, keyframes: [{time: 08:00, turbidity: 2}, {time: 16:00, "
                  "turbidity: 2.1}]}";
  const auto a = plan::estimate_cost(plan_of(still), {1, 2, 3});
  const auto b = plan::estimate_cost(plan_of(changing), {1, 2, 3});
  EXPECT_GT(b.core_seconds - b.table_core_seconds, a.core_seconds - a.table_core_seconds);
}

}  // namespace
