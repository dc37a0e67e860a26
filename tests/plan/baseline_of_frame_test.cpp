#include "plan/baseline_of_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plan/exposure_plan.h"
#include "plan_fixture.h"

namespace skylapse::plan {
namespace {

using ::testing::HasSubstr;
using testing::plan_errors;
using testing::plan_of;
using testing::Scene;

TEST(Baselines, RefuseASunThatHasSet) {
  for (const std::string model : {"preetham", "cie"}) {
    Scene scene;
    scene.time = "time: {zone: Europe/Prague, date: 2026-06-21, at: [12:00, 23:00]}";
    scene.more = "sky: {model: " + model + "}";
    const auto errors = plan_errors(scene);
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_THAT(errors[0].message, HasSubstr("and " + model + " ends at the horizon"));
    EXPECT_THAT(errors[0].hint, HasSubstr("bruneton"));
  }
}

TEST(Baselines, RefuseAMountain) {
  Scene scene;
  scene.location = "location: {name: top, latitude: 50, longitude: 14, height: 2500 m}";
  scene.more = "sky: {model: preetham}";
  const auto errors = plan_errors(scene);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_THAT(errors[0].message,
              HasSubstr("site 'top' is 2500 m high, and preetham stands on the ground"));
}

TEST(Baselines, AreNeverTakenByThemselves) { EXPECT_FALSE(is_baseline(plan_of({}).model)); }

TEST(Baselines, AreMeteredAsTheyAre) {
  for (const std::string model : {"preetham", "cie"}) {
    Scene scene;
    scene.more = "sky: {model: " + model + "}\nexposure: {mode: metered}";
    const Plan plan = plan_of(scene);
    SkyMeter meter(plan);
    const auto light = meter.read(plan.frames[0]);
    ASSERT_TRUE(light.ok());
    EXPECT_GT(light->in(cd_per_m2), 1500);
    EXPECT_LT(light->in(cd_per_m2), 12000);
  }
}

}  // namespace
}  // namespace skylapse::plan
