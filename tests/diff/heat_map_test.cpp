#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "diff/evidence.h"
#include "diff/facts.h"
#include "diff/heat_map_panel.h"
#include "diff/reports.h"
#include "diff/sample_pictures.h"
#include "output/atomic_file.h"
#include "output/image_writer.h"
#include "support/temporary_folder.h"

namespace skylapse::diff {
namespace {

const output::ImageIo& io() { return **output::open_image_io(); }

void write_exr(const image::Picture& picture, const std::filesystem::path& path) {
  const auto bytes = io().encode({.format = "exr",
                                  .width = picture.width,
                                  .height = picture.height,
                                  .pixels = picture.samples.data(),
                                  .channels = picture.channels});
  ASSERT_TRUE(bytes.ok());
  ASSERT_TRUE(output::write_file_atomically(path, *bytes).ok());
}

/// Two files of a folder, and what is known of them.
struct Files {
  TemporaryFolder folder;
  PairResult pair;
  Files(const image::Picture& a, const image::Picture& b) {
    write_exr(a, folder / "a.exr");
    write_exr(b, folder / "b.exr");
    pair.name = "sky.exr";
    pair.a.path = (folder / "a.exr").string();
    pair.b.path = (folder / "b.exr").string();
  }
};

image::Picture spotted(const image::Picture& picture, int x, int y, float factor) {
  return changed(picture, [=](float* rgb, int column, int row) {
    if (column == x && row == y)
      for (int c = 0; c < 3; ++c) rgb[c] *= factor;
  });
}

TEST(Evidence, HoldsBothPicturesAndTheirErrors) {
  const image::Picture a = sample_sky(180), b = spotted(a, 60, 60, 1.5f);
  const Files files(a, b);
  const auto evidence = read_evidence(files.pair);
  ASSERT_TRUE(evidence.ok());
  EXPECT_EQ(evidence->a.samples, a.samples);
  EXPECT_EQ(evidence->b.samples, b.samples);
  ASSERT_EQ(evidence->error.size(), a.pixel_count());
  EXPECT_NEAR(evidence->error[60 * 256 + 60], 1 / 3.0, 1e-6);  // (b - a) / max(a, b)
  EXPECT_EQ(evidence->error[60 * 256 + 61], 0);
  EXPECT_GT(evidence->flip[60 * 256 + 60], 0);
  EXPECT_EQ(evidence->flip[0], 0);
}

TEST(Evidence, OfEqualFilesIsNothingAndOfOtherSizesHasNoErrors) {
  const image::Picture a = sample_sky(180);
  const Files same(a, a), sizes(a, sample_sky(90, 5000, 128, 64));
  const auto equal = read_evidence(same.pair);
  ASSERT_TRUE(equal.ok());
  EXPECT_EQ(*std::ranges::max_element(equal->flip), 0);
  EXPECT_EQ(equal->flip.size(), a.pixel_count());
  const auto other = read_evidence(sizes.pair);
  ASSERT_TRUE(other.ok());
  EXPECT_TRUE(other->error.empty());
  EXPECT_TRUE(other->flip.empty());
}

TEST(Evidence, OfAFileThatIsGoneIsAnError) {
  Files files(sample_sky(180), sample_sky(180));
  std::filesystem::remove(files.pair.b.path);
  const auto evidence = read_evidence(files.pair);
  ASSERT_FALSE(evidence.ok());
  EXPECT_EQ(evidence.error().code, ErrorCode::missing_input);
  EXPECT_FALSE(write_heat_map(files.pair, (files.folder / "map.png").string()).ok());
}

TEST(HeatMap, AsExrHoldsTheErrorsInOneChannel) {
  const image::Picture a = sample_sky(180), b = spotted(a, 60, 60, 1.5f);
  const Files files(a, b);
  const std::string path = (files.folder / "sub" / "map.exr").string();
  ASSERT_TRUE(write_heat_map(files.pair, path).ok());
  const auto map = read_picture(path, {});
  ASSERT_TRUE(map.ok());
  EXPECT_EQ(map->picture.channels, std::vector<std::string>{"error"});
  EXPECT_EQ(map->picture.samples, read_evidence(files.pair)->error);
}

TEST(HeatMap, AsPngIsAPictureLargerThanTheMap) {
  const Files files(sample_sky(180), sample_sky(181));
  const std::string path = (files.folder / "map.png").string();
  ASSERT_TRUE(write_heat_map(files.pair, path).ok());
  const auto map = io().decode(path);
  ASSERT_TRUE(map.ok());
  EXPECT_GT(map->pixels.width(), 2 * 256);
  EXPECT_GT(map->pixels.height(), 2 * 128);
}

TEST(HeatMap, OfOtherKindsIsRefusedWithTheKindsThereAre) {
  const Files files(sample_sky(180), sample_sky(181));
  for (const std::string name : {"map.jpg", "map", "map.png.txt"}) {
    const Status refused = write_heat_map(files.pair, (files.folder / name).string());
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, ErrorCode::invalid_input);
    EXPECT_NE(refused.error().hint.find(".png"), std::string::npos);
  }
}

TEST(HeatMap, OfPicturesThatCannotBeComparedIsAllUnknown) {
  const Files files(sample_sky(180), sample_sky(90, 5000, 128, 64));
  ASSERT_TRUE(write_heat_map(files.pair, (files.folder / "map.png").string()).ok());
  const std::string path = (files.folder / "map.exr").string();
  ASSERT_TRUE(write_heat_map(files.pair, path).ok());
  const auto map = read_picture(path, {});
  ASSERT_TRUE(map.ok());
  for (const float e : map->picture.samples) ASSERT_TRUE(std::isinf(e));
}

TEST(HeatMapScale, IsLogarithmicAndHeldToItsEnds) {
  EXPECT_DOUBLE_EQ(place_on_scale(1, false), 1);
  EXPECT_NEAR(place_on_scale(0.01f, false), 0.5, 1e-6);
  EXPECT_EQ(place_on_scale(1e-9f, false), 0);
  EXPECT_EQ(place_on_scale(2, false), 1);
  EXPECT_DOUBLE_EQ(place_on_scale(255, true), 1);
  EXPECT_NEAR(place_on_scale(0.1f, true), 0, 1e-6);
}

/// The panel of pictures with the sky of every kind of camera.
image::FrameBuffer panel_of(const PairEvidence& evidence, image::SkyView view = {}) {
  PairResult pair;
  pair.name = "f.0001.exr";
  pair.view = view;
  auto panel = heat_map_panel(io(), pair, evidence, evidence.error);
  EXPECT_TRUE(panel.ok());
  return std::move(*panel);
}

bool has_colour(const image::FrameBuffer& image, float r, float g, float b) {
  for (size_t i = 0; i < image.data().size(); i += 3)
    if (image.data()[i] == r && image.data()[i + 1] == g && image.data()[i + 2] == b) return true;
  return false;
}

TEST(HeatMapPanel, ShowsWhatIsNoNumberInAColourOfItsOwn) {
  const image::Picture a = sample_sky(180);
  const auto plain = evidence_of(a, spotted(a, 60, 60, 1.5f));
  const auto odd = evidence_of(a, spotted(a, 60, 60, std::numeric_limits<float>::infinity()));
  const auto count = [](const image::FrameBuffer& image) {
    int cyan = 0;
    for (size_t i = 0; i < image.data().size(); i += 3)
      cyan += image.data()[i] == 0 && image.data()[i + 1] == 0.9f && image.data()[i + 2] == 0.9f;
    return cyan;
  };
  const int in_the_key = count(panel_of(plain));
  EXPECT_GT(in_the_key, 0);
  EXPECT_EQ(count(panel_of(odd)), in_the_key + 4);  // one pixel, magnified twice
}

TEST(HeatMapPanel, MarksTheWorstPlaceAndTheSun) {
  const image::Picture a = sample_sky(180);
  const auto evidence = evidence_of(a, spotted(a, 60, 60, 1.5f));
  EXPECT_TRUE(has_colour(panel_of(evidence), 0.2f, 1, 0.3f));
  EXPECT_FALSE(has_colour(panel_of(evidence_of(a, a)), 0.2f, 1, 0.3f));
  image::SkyView view{.camera = sample_camera(), .sun = enu_direction(70 * deg, 34 * deg)};
  EXPECT_NE(panel_of(evidence, view).data(), panel_of(evidence).data());
}

TEST(HeatMapPanel, CanBeMadeOfEverySizeAndCamera) {
  using enum image::Projection;
  for (const auto& [width, height] :
       {std::pair{1, 1}, {5, 3}, {1, 3000}, {6000, 2}, {700, 500}, {64, 64}}) {
    const image::Picture a = sample_sky(180, 5000, width, height);
    const auto evidence = evidence_of(a, spotted(a, 0, 0, 2));
    for (const auto projection : {perspective, fisheye_equidistant, fisheye_equisolid,
                                  fisheye_stereographic, lat_long, cube, octahedral, mirror_ball}) {
      image::SkyView view{.camera = sample_camera(width, height),
                          .sun = enu_direction(200 * deg, 20 * deg)};
      view.camera->projection = projection;
      if (projection == cube) view.camera->cube_layout = image::CubeLayout::vertical_strip;
      const auto panel = panel_of(evidence, view);
      EXPECT_GE(panel.width(), 500);
      EXPECT_LE(panel.width(), 5000);
      for (const float v : panel.data()) {
        ASSERT_GE(v, 0);
        ASSERT_LE(v, 1);
      }
    }
  }
}

}  // namespace
}  // namespace skylapse::diff
