#include "plan/plan.h"

#include "plan/cost_model.h"
#include "plan/plan_fixture.h"

using namespace skylapse;
using namespace skylapse::plan::testing;

namespace {

TEST(Plan, IsTheSameEachTime) {
  const auto a = plan_of(Scene{}), b = plan_of(Scene{});
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (size_t i = 0; i < a.frames.size(); ++i) {
    EXPECT_EQ(a.frames[i].ev, b.frames[i].ev);
    EXPECT_EQ(a.frames[i].sky.sun_apparent.vec(), b.frames[i].sky.sun_apparent.vec());
    EXPECT_EQ(a.frames[i].paths, b.frames[i].paths);
  }
}

TEST(Plan, NumbersRestartWhereTheNameDiffers) {
  Scene scene;
  scene.location =
      "locations: [{name: A, latitude: 0, longitude: 0}, {name: B, latitude: 10, longitude: 0}]";
  scene.outputs = "outputs: [{image: \"{site}.####.png\"}]";
  const auto plan = plan_of(scene);
  EXPECT_EQ(plan.frames[0].paths[0], "A.0001.png");
  EXPECT_EQ(plan.frames[3].paths[0], "B.0001.png");
}

TEST(Plan, NumbersRunOnWhereTheNameIsTheSame) {
  Scene scene;
  scene.location =
      "locations: [{name: A, latitude: 0, longitude: 0}, {name: B, latitude: 10, longitude: 0}]";
  EXPECT_EQ(plan_of(scene).frames[5].paths[0], "f.0006.png");
}

TEST(Plan, TwoFramesNeverWriteOneFile) {
  // The clock reads 02:00 twice in this night.
  Scene scene;
  scene.time = "time: {zone: Europe/Prague, date: 2024-10-27, from: 00:00, to: 05:00, step: 1 h}";
  scene.outputs = "outputs: [{image: \"{date}-{time}.png\"}]";
  const auto errors = plan_errors(scene);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].message.find("frames 3 and 4 would both write '2024-10-27-020000.png'"),
            std::string::npos)
      << errors[0].message;
  EXPECT_GT(errors[0].span.line, 0);
}

TEST(Plan, FacesCountWhereFilesCollide) {
  Scene scene;
  scene.time = "time: {zone: UTC, at: [2026-06-21 12:00]}";
  scene.camera = "camera: {name: px, projection: cube, size: 16, layout: faces}";
  scene.outputs = "outputs: [{image: \"{face}/{camera}.exr\"}, {image: \"{camera}/{face}.exr\"}]";
  const auto errors = plan_errors(scene);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].message.find("would both write 'px/px.exr'"), std::string::npos)
      << errors[0].message;
}

TEST(Plan, NoLocationIsNamedLikeTheRecordsOfTheProgram) {
  for (const char* name : {"manifest.json", ".skylapse"}) {
    Scene scene;
    scene.location = "location: {name: " + std::string(name) + ", latitude: 50, longitude: 14}";
    scene.outputs = "outputs: [{image: \"{site}/####.png\"}]";
    const auto errors = plan_errors(scene);
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_NE(errors[0].message.find("the program's own records"), std::string::npos)
        << errors[0].message;
  }
}

TEST(Plan, AMovieIsOneFileForManyFrames) {
  Scene scene;
  scene.outputs = "outputs: [{movie: day.mp4}]";
  EXPECT_EQ(plan_of(scene).frames.size(), 3u);
}

TEST(Plan, SeparateCubeFacesAreSixFiles) {
  Scene scene;
  scene.camera = "camera: {projection: cube, size: 16, layout: faces}";
  scene.outputs = "outputs: [{image: \"{face}.####.exr\"}]";
  const auto plan = plan_of(scene);
  EXPECT_EQ(plan::files_of(plan, plan.frames[0], 0),
            (std::vector<std::string>{"px.0001.exr", "nx.0001.exr", "py.0001.exr", "ny.0001.exr",
                                      "pz.0001.exr", "nz.0001.exr"}));
}

TEST(Plan, CostGrowsWithPixelsAndFrames) {
  const auto small = plan_of(Scene{});
  Scene large_scene;
  large_scene.camera =
      "camera: {projection: perspective, look_at: {azimuth: 180 deg, elevation: 20 deg}, fov: 90 "
      "deg, size: 640x360}";
  const auto large = plan_of(large_scene);
  const auto one = plan::estimate_cost(small, {1}), all = plan::estimate_cost(small, {1, 2, 3});
  EXPECT_NEAR(all.core_seconds, 3 * one.core_seconds, 1e-12);
  EXPECT_NEAR(plan::estimate_cost(large, {1}).bytes, 100 * one.bytes, 1);
}

}  // namespace
