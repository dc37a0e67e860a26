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

TEST(ContactSheet, LabelsStayUnderTheirOwnPicture) {
  const TemporaryFolder folder;
  const auto picture = folder.path() / "black.png";
  const auto* io = *output::open_image_io();
  const std::vector<uint8_t> black(size_t{3} * 64 * 8, 0);
  output::EncodeRequest request;
  request.format = "png", request.width = 64, request.height = 8;
  request.type = output::SampleType::u8;
  request.pixels = black.data();
  const auto bytes = io->encode(request);
  ASSERT_TRUE(bytes.ok());
  std::ofstream(picture, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes->data()), std::streamsize(bytes->size()));
  const std::vector<ExistingFrame> frames{
      {picture, "06-21 04:30  sun -3.2", {"04:30  sun -3.2", "04:30"}},
      {picture, "a_name_without_anything_shorter_to_say", {}}};
  for (const int width : {16, 40, 64, 100, 130, 240}) {
    const auto sheet = folder.path() / "sheet.png";
    ASSERT_TRUE(make_contact_sheet(frames, sheet, {.columns = 2, .thumbnail_width = width}).ok());
    const auto image = io->decode(sheet.string());
    ASSERT_TRUE(image.ok());
    const auto& pixels = image->pixels;
    int bright = 0, in_gaps = 0;
    for (int y = 0; y < pixels.height(); ++y)
      for (int x = 0; x < pixels.width(); ++x) {
        const bool gap = x < 4 || (x >= 4 + width && x < 8 + width) || x >= 8 + 2 * width;
        const float v = pixels.pixel(x, y)[0];
        in_gaps += gap && v > 0.13f;  // the background is 31 of 255, text is white
        bright += !gap && v > 0.5f;
      }
    EXPECT_EQ(in_gaps, 0) << width;
    EXPECT_GT(bright, 0) << "no label at all: is a font installed?";
  }
}

TEST(ContactSheet, OnlyKnownExtensionsAreWritten) {
  const TemporaryFolder folder;
  for (const char* name : {"x.bmp", "x", "x.exr"}) {
    const Status made = make_contact_sheet({{"none.png", "none"}}, folder.path() / name, {});
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().code, ErrorCode::invalid_input);
  }
}

TEST(ExistingFrames, ACubesFacesApartAreLabelledAsTheFaceShown) {
  const TemporaryFolder folder;
  std::string files;
  for (const char* face : {"px", "nx", "py", "ny", "pz", "nz"}) {
    const std::string name = std::string("f.") + face + ".0001.png";
    std::ofstream(folder.path() / name);
    files += (files.empty() ? "" : ",") + ("{\"path\": \"" + name + "\"}");
  }
  std::ofstream(folder.path() / "manifest.json")
      << R"({"frames": [{"local": "2026-06-21T04:30:00+02:00", "sun": {"elevation_deg": -3.21},)"
      << "\"files\": [" << files << "]}]}";
  const auto frames = existing_frames(folder.path(), {"png"});
  ASSERT_TRUE(frames.ok());
  ASSERT_EQ(frames->size(), 1u);
  EXPECT_EQ(frames->front().label, "06-21 04:30 px  sun -3.2");
  EXPECT_EQ(frames->front().shorter, (std::vector<std::string>{"04:30 px  sun -3.2", "04:30 px"}));
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
