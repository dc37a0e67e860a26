#include "image/camera/camera_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "sample_cameras.h"

namespace skylapse::image {
namespace {

using testing::HasSubstr;
using enum Projection;

void expect_problem(const Camera& c, const std::string& value, const std::string& allowed) {
  const auto problem = camera_problem(c);
  ASSERT_TRUE(problem);
  EXPECT_THAT(*problem, HasSubstr(value));
  EXPECT_THAT(*problem, HasSubstr(allowed));
}

TEST(CameraProblem, IsNoneForUsableCameras) {
  for (const auto& [name, camera] : sample_cameras()) EXPECT_FALSE(camera_problem(camera)) << name;
  Camera c;
  c.width = c.height = 1;
  EXPECT_FALSE(camera_problem(c));
  EXPECT_FALSE(camera_problem(make_camera(lat_long, 65536, 32768, {})));
}

TEST(CameraProblem, NamesTheSizeAndItsRange) {
  expect_problem(make_camera(perspective, 0, 5, 60 * deg), "0x5", "1 to 65536");
  expect_problem(make_camera(lat_long, 4, -2, {}), "4x-2", "1 to 65536");
  expect_problem(make_camera(perspective, 1000000, 5, 60 * deg), "1000000x5", "1 to 65536");
}

TEST(CameraProblem, NamesTheFieldOfViewAndTheRangeOfTheProjection) {
  expect_problem(make_camera(perspective, 4, 4, 180 * deg), "180 deg", "below 180");
  expect_problem(make_camera(perspective, 4, 4, 0 * deg), "0 deg", "above 0");
  expect_problem(make_camera(fisheye_equisolid, 4, 4, 361 * deg), "361 deg", "up to 360");
  expect_problem(make_camera(fisheye_stereographic, 4, 4, 360 * deg), "360 deg", "below 360");
  expect_problem(make_camera(perspective, 4, 4, std::numeric_limits<double>::quiet_NaN() * deg),
                 "nan", "above 0");
  EXPECT_FALSE(camera_problem(make_camera(fisheye_equidistant, 4, 4, 360 * deg)));
  EXPECT_FALSE(camera_problem(make_camera(lat_long, 4, 4, -3 * deg)));  // not read
}

TEST(CameraProblem, NamesASizeThatFitsTheCubesLayout) {
  const glm::dmat3 north = look_at({}, {}, {});
  expect_problem(make_camera(cube, 600, 100, {}), "600x100", "n x 6n");
  expect_problem(make_camera(cube, 100, 600, {}, north, CubeLayout::horizontal_strip), "100x600",
                 "6n x n, for instance 96x16");
  expect_problem(make_camera(cube, 400, 301, {}, north, CubeLayout::cross), "400x301",
                 "4n x 3n, for instance 400x300");
  expect_problem(make_camera(cube, 301, 400, {}, north, CubeLayout::vertical_cross), "301x400",
                 "3n x 4n, for instance 300x400");
  expect_problem(make_camera(octahedral, 200, 100, {}), "200x100", "a square");
}

TEST(CameraProblem, FindsAxesThatAreNoOrientation) {
  Camera c = make_camera(perspective, 4, 4, 60 * deg);
  c.camera_to_enu = glm::dmat3(1.0);
  expect_problem(c, "mirror", "backward");
  c.camera_to_enu = 2.0 * look_at({}, {}, {});
  expect_problem(c, "unit vectors", "right angles");
  expect_problem(make_camera(lat_long, 4, 2, {}, look_at({}, 10 * deg, {})), "upright", "heading");
  expect_problem(make_camera(octahedral, 4, 4, {}, look_at({}, 10 * deg, {})), "upright",
                 "heading");
}

}  // namespace
}  // namespace skylapse::image
