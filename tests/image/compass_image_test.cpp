#include "image/compass_image.h"

#include <gtest/gtest.h>

#include "sample_cameras.h"

namespace skylapse::image {
namespace {

using enum Projection;

glm::vec3 color_at(const FrameBuffer& image, double x, double y) {
  const float* p = image.pixel(int(x), int(y));
  return {p[0], p[1], p[2]};
}

bool has_color(const FrameBuffer& image, double x, double y, CompassMark mark) {
  return glm::length(color_at(image, x, y) - compass_color(mark)) < 1e-6F;
}

// Beside the letters, 10 deg from the marks' centres.
TEST(CompassImage, LatLongReadsWestNorthEastSouth) {
  const FrameBuffer image = compass_image(make_camera(lat_long, 360, 180, {}));
  EXPECT_TRUE(has_color(image, 180, 81, CompassMark::north));
  EXPECT_TRUE(has_color(image, 270, 81, CompassMark::east));
  EXPECT_TRUE(has_color(image, 90, 81, CompassMark::west));
  EXPECT_TRUE(has_color(image, 0, 81, CompassMark::south));
  EXPECT_TRUE(has_color(image, 359, 81, CompassMark::south));
  EXPECT_TRUE(has_color(image, 33, 10, CompassMark::up));
  EXPECT_TRUE(has_color(image, 33, 169, CompassMark::down));
}

TEST(CompassImage, CubeFacesHaveTheirMarksInTheMiddle) {
  const FrameBuffer image = compass_image(make_camera(cube, 90, 540, {}));
  const CompassMark order[] = {CompassMark::west, CompassMark::east,  CompassMark::up,
                               CompassMark::down, CompassMark::north, CompassMark::south};
  for (int face = 0; face < 6; ++face)
    EXPECT_TRUE(has_color(image, 45, 90 * face + 37.3, order[face])) << face;
}

TEST(CompassImage, LettersAreNotMirrored) {
  // The E of east has its stem at the left and its gaps at the right.
  const Camera c = make_camera(perspective, 200, 200, 30 * deg, look_at(90 * deg, {}, {}));
  const FrameBuffer image = compass_image(c);
  const auto ink = [&](double right_deg, double up_deg) {
    const auto p = position_of(c, enu_direction((90 + right_deg) * deg, up_deg * deg));
    return glm::length(color_at(image, p->x, p->y)) < 0.01F;
  };
  EXPECT_TRUE(ink(-4.6, 4));
  EXPECT_TRUE(ink(-4.6, -4));
  EXPECT_TRUE(ink(4.6, 7));
  EXPECT_TRUE(ink(4.6, -7));
  EXPECT_FALSE(ink(4.6, 3.5));
  EXPECT_FALSE(ink(4.6, -3.5));
}

TEST(CompassImage, IsBlackOutsideTheFisheyesCircle) {
  const FrameBuffer image = compass_image(zenith_fisheye(fisheye_equisolid, 100));
  EXPECT_EQ(color_at(image, 2, 2), glm::vec3(0));
  EXPECT_TRUE(has_color(image, 50, 56, CompassMark::up) ||
              has_color(image, 50, 55, CompassMark::up));
  EXPECT_TRUE(has_color(image, 50, 3.5, CompassMark::north));
}

TEST(CompassImage, CanBeMadeForEveryCamera) {
  for (const auto& [name, camera] : sample_cameras()) {
    const FrameBuffer image = compass_image(camera);
    for (const float v : image.data()) ASSERT_TRUE(v >= 0 && v <= 1) << name;
  }
}

}  // namespace
}  // namespace skylapse::image
