#include "study/ladder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "study/study_scenes.h"

namespace skylapse::study {
namespace {

StudyScene built_in_scene(const std::string& name) {
  StudyOptions options;
  options.scenes = {name};
  auto scenes = scenes_of(options);
  EXPECT_TRUE(scenes) << (scenes ? "" : scenes.error().front().message);
  return scenes->front();
}

TEST(Ladder, RungsAreUniqueAndTheQuickOnesAreAmongThem) {
  std::set<std::string> ids;
  for (const Rung& rung : ladder(false)) EXPECT_TRUE(ids.insert(rung.id).second) << rung.id;
  EXPECT_TRUE(ids.contains(kBaseRung));
  for (const Rung& rung : ladder(true)) EXPECT_TRUE(ids.contains(rung.id));
  EXPECT_LT(ladder(true).size(), ladder(false).size() / 2);
}

TEST(Ladder, EveryRungBelongsToAGroupThatIsExplained) {
  for (const Rung& rung : ladder(false))
    EXPECT_TRUE(std::any_of(rung_groups().begin(), rung_groups().end(), [&](const RungGroup& g) {
      return g.name == rung.group;
    })) << rung.id;
}

TEST(Ladder, EveryRungIsAConfigThatTheProductTakes) {
  const StudyScene scene = built_in_scene("noon");
  for (const Rung& rung : ladder(false)) {
    const auto job = job_of_rung(rung, scene.load);
    EXPECT_TRUE(job) << rung.id << ": " << (job ? "" : job.error().front().message);
  }
}

TEST(Ladder, TheScenesOwnSkyDoesNotStandInTheWayOfARung) {
  const auto load = [](const std::vector<config::Override>& overrides) {
    return config::parse_job(
        "location: {latitude: 50 deg, longitude: 15 deg}\n"
        "time: {at: [2026-06-21T12:00Z]}\n"
        "sky: {model: bruneton, level: fine}\n"
        "camera: {projection: lat-long, size: 64x32}\noutputs: [{image: a.exr}]\n",
        "scene.yaml", overrides);
  };
  Rung fitted;
  fitted.id = "hosek", fitted.overrides = {{"sky.model", "hosek-wilkie"}};
  const auto job = job_of_rung(fitted, load);
  ASSERT_TRUE(job) << job.error().front().message;
  EXPECT_EQ(job->sky.model, config::SkyModel::hosek_wilkie);
  EXPECT_EQ(job->sky.level, sky::bruneton::Level::standard);
}

TEST(Ladder, AFittedSkyIsRefusedWhereTheAirAsksForMore) {
  const auto load = [](const std::vector<config::Override>& overrides) {
    return config::parse_job(
        "location: {latitude: 50 deg, longitude: 15 deg}\n"
        "time: {at: [2026-06-21T12:00Z]}\nair: {ozone: 250 DU}\n"
        "camera: {projection: lat-long, size: 64x32}\noutputs: [{image: a.exr}]\n",
        "scene.yaml", overrides);
  };
  Rung fitted;
  fitted.id = "hosek", fitted.overrides = {{"sky.model", "hosek-wilkie"}};
  const auto job = job_of_rung(fitted, load);
  ASSERT_FALSE(job);
  EXPECT_NE(job.error().front().message.find("air.ozone"), std::string::npos);
}

TEST(StudyScenes, TheFourStandWhereTheirTitlesSay) {
  const std::pair<const char*, double> suns[] = {
      {"noon", 63.4}, {"low_sun", 5.0}, {"twilight", -4.0}, {"airliner", 19.9}};
  for (const auto& [name, sun] : suns) {
    StudyScene scene = built_in_scene(name);
    const auto plan = prepare_scene(scene, Sampling::quick);
    ASSERT_TRUE(plan) << plan.error().front().message;
    EXPECT_NEAR(scene.sun_elevation.in(deg), sun, 0.05) << name;
    EXPECT_FALSE(scene.points.empty());
  }
}

TEST(StudyScenes, AnUnknownNameIsAnErrorThatListsThem) {
  StudyOptions options;
  options.scenes = {"nonn"};
  const auto scenes = scenes_of(options);
  ASSERT_FALSE(scenes);
  EXPECT_NE(scenes.error().front().hint.find("twilight"), std::string::npos);
}

}  // namespace
}  // namespace skylapse::study
