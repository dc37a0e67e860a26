// Names of files: sizes, levels, faces of views of their own, and that no two are alike.
#include <set>

#include "plan/plan_fixture.h"

using namespace skylapse;
using namespace skylapse::plan::testing;

namespace {

using Names = std::vector<std::string>;

Names files_with(const std::string& outputs, size_t output = 0) {
  Scene scene;
  scene.camera = "camera: {projection: lat-long, size: 2048x1024}";
  scene.outputs = "outputs: [" + outputs + "]";
  const auto plan = plan_of(scene);
  return plan::files_of(plan, plan.frames[0], output);
}

TEST(OutputNames, SizesAreThoseOfTheOutputsOwnView) {
  EXPECT_EQ(files_with("{image: \"{size}.####.exr\"}"), Names{"2k.0001.exr"});
  EXPECT_EQ(files_with("{image: \"{size}.####.exr\", size: 16384x8192}"), Names{"16k.0001.exr"});
  EXPECT_EQ(files_with("{image: \"{size}.####.exr\", size: 1000x500}"), Names{"1000x500.0001.exr"});
  EXPECT_EQ(files_with("{image: \"{size}.####.exr\", projection: cube, size: 256}"),
            Names{"256.0001.exr"});
  EXPECT_EQ(files_with("{image: \"{size}.####.exr\", projection: cube, size: 256, layout: cross}"),
            Names{"256.0001.exr"});
  EXPECT_EQ(files_with("{image: \"{size}.####.exr\", projection: octahedral, size: 1024}"),
            Names{"1024.0001.exr"});
  EXPECT_EQ(files_with("{specular: \"{size}.####.ktx2\", size: 64}"), Names{"64.0001.ktx2"});
  EXPECT_EQ(files_with("{movie: \"{size}.mp4\"}"), Names{"2k.mp4"});
}

TEST(OutputNames, FacesBelongToTheOutput) {
  const Names faces =
      files_with("{image: \"{face}.####.exr\", projection: cube, size: 16, layout: faces}");
  EXPECT_EQ(faces, (Names{"px.0001.exr", "nx.0001.exr", "py.0001.exr", "ny.0001.exr", "pz.0001.exr",
                          "nz.0001.exr"}));
  // A cube of the job's camera leaves maps of their own whole.
  Scene scene;
  scene.camera = "camera: {projection: cube, size: 16, layout: faces}";
  scene.outputs =
      "outputs: [{image: \"{face}.####.exr\"}, {image: m.####.exr, projection: lat-long}, "
      "{harmonics: h.####.json}]";
  const auto plan = plan_of(scene);
  EXPECT_EQ(plan::files_of(plan, plan.frames[0], 0).size(), 6u);
  EXPECT_EQ(plan::files_of(plan, plan.frames[0], 1), Names{"m.0001.exr"});
  EXPECT_EQ(plan::files_of(plan, plan.frames[0], 2), Names{"h.0001.json"});
}

TEST(OutputNames, LevelsComeOneAfterAnother) {
  EXPECT_EQ(files_with("{specular: \"{level}.####.exr\", size: 16}"),
            (Names{"0.0001.exr", "1.0001.exr", "2.0001.exr"}));
  const Names apart = files_with("{specular: \"{level}{face}.####.exr\", size: 8}");
  ASSERT_EQ(apart.size(), 12u);
  EXPECT_EQ(apart[0], "0px.0001.exr");
  EXPECT_EQ(apart[6], "1px.0001.exr");
  EXPECT_EQ(apart[11], "1nz.0001.exr");
}

TEST(OutputNames, NoTwoFilesOfAFrameAreAlike) {
  Scene scene;
  scene.camera = "camera: {projection: lat-long, size: 2048x1024}";
  scene.outputs = "outputs: [{image: \"{size}.####.exr\"}, {image: \"2k.####.exr\", size: 64x32}]";
  const auto errors = plan_errors(scene);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].message.find("two outputs of frame 1 would both write '2k.0001.exr'"),
            std::string::npos)
      << errors[0].message;
}

TEST(OutputNames, ALibrarysFileIsNoneOfAFrames) {
  Scene scene;
  scene.location = "location: {name: index, latitude: 50, longitude: 14}";
  scene.time = "time: {zone: UTC, date: 2026-06-21, at: 12:00}";
  scene.outputs = "outputs: [{image: \"{site}.png\"}, {sheet: index.png, image: \"{site}.png\"}]";
  EXPECT_NE(plan_errors(scene)[0].message.find("would both write 'index.png'"), std::string::npos);
}

TEST(OutputNames, HoldNoSpacesWhateverThePlaceIsCalled) {
  Scene scene;
  scene.location = "location: {name: \"Sao Paulo (SP)\", latitude: -23, longitude: -46}";
  scene.outputs = "outputs: [{image: \"{site}.####.png\"}]";
  EXPECT_EQ(plan_of(scene).frames[0].paths[0], "Sao-Paulo--SP-.0001.png");
}

}  // namespace
