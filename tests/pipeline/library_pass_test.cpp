// What is made of all frames of a job.
#include "pipeline/library/library_pass.h"

#include <set>

#include "pipeline/job_fixture.h"
#include "pipeline/library/sheet.h"

using namespace skylapse;
using namespace skylapse::pipeline;
using namespace skylapse::pipeline::testing;

namespace {

const std::string kSheet = "{image: \"p.####.png\"}, {sheet: s.png, image: \"p.####.png\"}";

TEST(LibraryPass, AFinishedSheetIsKeptAndAStaleOneMadeAgain) {
  const TemporaryFolder folder;
  const auto plan = plan_of_text(small_scene(kSheet));
  ASSERT_TRUE(run_job(plan, options_for(plan, folder.path())).ok());
  const auto first = hashes(folder.path()).at("s.png");
  const auto again = run_job(plan, options_for(plan, folder.path()));
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again->bytes_written, 0u);
  const auto brighter = plan_of_text(small_scene(kSheet, "exposure: {compensation: 1 stop}"));
  ASSERT_TRUE(run_job(brighter, options_for(brighter, folder.path())).ok());
  EXPECT_NE(hashes(folder.path()).at("s.png"), first);
}

TEST(LibraryPass, MoreColumnsAreAnotherSheetOfTheSamePictures) {
  const TemporaryFolder folder;
  const auto two = plan_of_text(
      small_scene("{image: \"p.####.png\"}, {sheet: s.png, image: \"p.####.png\", columns: 2}"));
  ASSERT_TRUE(run_job(two, options_for(two, folder.path())).ok());
  const auto before = hashes(folder.path());
  const auto three = plan_of_text(
      small_scene("{image: \"p.####.png\"}, {sheet: s.png, image: \"p.####.png\", columns: 3}"));
  const auto summary = run_job(three, options_for(three, folder.path()));
  ASSERT_TRUE(summary.ok());
  EXPECT_EQ(summary->rendered, 0);
  EXPECT_NE(hashes(folder.path()).at("s.png"), before.at("s.png"));
}

/// A preview in the same display is no source of a movie's pictures.
TEST(LibraryPass, AMovieShowsTheCameraWhateverElseIsWritten) {
  const auto alone = plan_of_text(small_scene("{movie: p.mp4, view: ACES SDR}"));
  const auto beside = plan_of_text(small_scene(
      "{image: \"small.####.png\", view: ACES SDR, size: 32x18}, {image: \"sky.####.png\", view: "
      "ACES SDR, content: sky}, {movie: p.mp4, view: ACES SDR}"));
  const TemporaryFolder a, b;
  ASSERT_TRUE(run_job(alone, options_for(alone, a.path())).ok());
  ASSERT_TRUE(run_job(beside, options_for(beside, b.path())).ok());
  EXPECT_EQ(hashes(a.path()).at("p.mp4"), hashes(b.path()).at("p.mp4"));
}

/// A dome is turned and scaled as its map is, and holds the sun that the map leaves out.
TEST(LibraryPass, ADomeIsMadeAgainWhenItsMapChanges) {
  const auto dome_with = [](const std::string& map, const std::filesystem::path& folder) {
    const auto plan = plan_of_text(
        "location: {name: Prague, latitude: 50.0755, longitude: 14.4378}\n"
        "time: {zone: Europe/Prague, date: 2026-06-21, at: 12:00}\n"
        "camera: {projection: lat-long, size: 64x32}\n"
        "outputs: [{image: \"m_{size}.exr\"" +
        map + "}, {dome: d.usda, map: \"m_{size}.exr\"}]\n");
    EXPECT_TRUE(run_job(plan, options_for(plan, folder)).ok());
    return hashes(folder).at("d.usda");
  };
  const TemporaryFolder folder, fresh;
  std::set<std::string> domes;
  for (const char* map : {"", ", content: sky", ", size: 32x16", ", look_at: south"}) {
    const auto dome = dome_with(map, folder.path());
    EXPECT_EQ(dome, dome_with(map, fresh.path() / std::to_string(domes.size()))) << map;
    domes.insert(dome);
  }
  EXPECT_EQ(domes.size(), 4u);
}

TEST(Sheet, LabelsSaySiteTimeSunAndWhatDiffers) {
  const auto plan = plan_of_text(
      "location: {name: Prague, latitude: 50.0755, longitude: 14.4378}\n"
      "time: {zone: Europe/Prague, date: 2026-06-21, sun_elevations: [30 deg], half: morning}\n"
      "air: {turbidity: [2, 4]}\ncamera: {projection: lat-long, size: 64x32}\n"
      "outputs: [{image: \"{turbidity}.png\"}]\n");
  const auto frame = labelled_frame(plan, plan.frames[1], "x.png");
  EXPECT_EQ(frame.label, "Prague  2026-06-21 08:21  sun 30.0  T 4");
  ASSERT_FALSE(frame.shorter.empty());
  EXPECT_EQ(frame.shorter.front(), "Prague  06-21 08:21  sun 30.0  T 4");
  EXPECT_EQ(frame.shorter.back(), "sun 30.0  T 4");
}

}  // namespace
