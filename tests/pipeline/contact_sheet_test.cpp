#include "pipeline/contact_sheet.h"

#include "output/image_writer.h"
#include "pipeline/job_fixture.h"

using namespace skylapse;
using namespace skylapse::pipeline;
using namespace skylapse::pipeline::testing;

namespace {

TEST(ContactSheet, ShowsEveryFrameOfAJobInOrder) {
  const auto plan = plan_of_text(small_scene("{image: \"p.####.png\"}"));
  const TemporaryFolder folder;
  ASSERT_TRUE(run_job(plan, options_for(plan, folder.path())).ok());
  const auto frames = existing_frames(folder.path(), {"png"});
  ASSERT_TRUE(frames.ok());
  ASSERT_EQ(frames->size(), 6u);
  EXPECT_EQ(frames->front().path.filename(), "p.0001.png");
  EXPECT_NE(frames->front().label.find("06-21"), std::string::npos) << frames->front().label;
  const auto sheet = folder.path() / "sheet.png";
  ASSERT_TRUE(make_contact_sheet(*frames, sheet, {.columns = 3, .thumbnail_width = 96}).ok());
  const auto image = (*output::open_image_io())->decode(sheet.string());
  ASSERT_TRUE(image.ok());
  EXPECT_EQ(image->pixels.width(), 3 * 100 + 4);
  EXPECT_EQ(image->pixels.height(), 2 * (54 + 22) + 4);
}

TEST(ExistingFrames, WithoutAManifestNumbersCountAsNumbers) {
  const TemporaryFolder folder;
  for (const char* name : {"f10.png", "f9.png", "f100.png"}) std::ofstream(folder.path() / name);
  const auto frames = existing_frames(folder.path(), {"png"});
  ASSERT_EQ(frames->size(), 3u);
  EXPECT_EQ((*frames)[0].label, "f9");
  EXPECT_EQ((*frames)[2].label, "f100");
}

TEST(ExistingFrames, AnEmptyOrMissingFolderIsMissingInput) {
  const TemporaryFolder folder;
  EXPECT_EQ(existing_frames(folder.path(), {"png"}).error().code, ErrorCode::missing_input);
  EXPECT_EQ(existing_frames(folder.path() / "no", {"png"}).error().code, ErrorCode::missing_input);
}

}  // namespace
