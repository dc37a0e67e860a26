// Compass test: north, east, south, west, up and down land where docs/conventions.md says.
#include <gtest/gtest.h>

#include "image/camera/cube.h"
#include "sample_cameras.h"

namespace skylapse::image {
namespace {

const Direction<Enu> kNorth = enu_direction(0 * deg, {});
const Direction<Enu> kEast = enu_direction(90 * deg, {});
const Direction<Enu> kSouth = enu_direction(180 * deg, {});
const Direction<Enu> kWest = enu_direction(270 * deg, {});
const Direction<Enu> kUp = Direction<Enu>::from_vector({0, 0, 1});
const Direction<Enu> kDown = Direction<Enu>::from_vector({0, 0, -1});

void expect_at(const Camera& c, const Direction<Enu>& d, double x, double y) {
  const auto p = position_of(c, d);
  ASSERT_TRUE(p);
  EXPECT_NEAR(p->x, x, 1e-9);
  EXPECT_NEAR(p->y, y, 1e-9);
}

TEST(Orientation, LatLongHasNorthInTheMiddleAndEastToTheRight) {
  const Camera c = make_camera(Projection::lat_long, 400, 200, {});
  expect_at(c, kNorth, 200, 100);
  expect_at(c, kEast, 300, 100);
  expect_at(c, kWest, 100, 100);
  EXPECT_NEAR(position_of(c, kUp)->y, 0, 1e-9);
  EXPECT_NEAR(position_of(c, kDown)->y, 200, 1e-9);
  expect_at(c, enu_direction(0 * deg, 45 * deg), 200, 50);
}

TEST(Orientation, LatLongTurnsWithItsHeading) {
  const Camera c = make_camera(Projection::lat_long, 400, 200, {}, look_at(90 * deg, {}, {}));
  expect_at(c, kEast, 200, 100);
  expect_at(c, kSouth, 300, 100);
  expect_at(c, kNorth, 100, 100);
}

TEST(Orientation, PerspectiveFacingNorthHasEastToTheRightAndUpOnTop) {
  const Camera c = make_camera(Projection::perspective, 200, 100, 90 * deg);
  expect_at(c, kNorth, 100, 50);
  expect_at(c, enu_direction(45 * deg, {}), 200, 50);
  expect_at(c, enu_direction(-45 * deg, {}), 0, 50);
  EXPECT_LT(position_of(c, enu_direction({}, 10 * deg))->y, 50);
}

TEST(Orientation, PerspectiveIsAsAPersonSeesIt) {
  const Camera c =
      make_camera(Projection::perspective, 200, 100, 80 * deg, look_at(270 * deg, 15 * deg, {}));
  expect_at(c, enu_direction(270 * deg, 15 * deg), 100, 50);
  EXPECT_GT(position_of(c, enu_direction(280 * deg, 15 * deg))->x, 100);  // north of west: right
}

// A fisheye that looks up is seen from below: with north on top, east is to the left.
TEST(Orientation, ZenithFisheyeWithNorthOnTopHasEastToTheLeft) {
  const Camera c = zenith_fisheye(Projection::fisheye_equidistant, 200);
  expect_at(c, kUp, 100, 100);
  expect_at(c, kNorth, 100, 0);
  expect_at(c, kSouth, 100, 200);
  expect_at(c, kEast, 0, 100);
  expect_at(c, kWest, 200, 100);
}

TEST(Orientation, ZenithFisheyeAtAzimuthZeroHasSouthOnTop) {
  const Camera c =
      make_camera(Projection::fisheye_equisolid, 200, 200, 180 * deg, look_at({}, 90 * deg, {}));
  expect_at(c, kSouth, 100, 0);
  expect_at(c, kEast, 200, 100);
}

TEST(Orientation, CubeStripsFollowOpenExr) {
  // Faces in order: west, east, up, down, north, south.
  const Camera v = make_camera(Projection::cube, 10, 60, {});
  const Camera h =
      make_camera(Projection::cube, 60, 10, {}, look_at({}, {}, {}), CubeLayout::horizontal_strip);
  int k = 0;
  for (const auto& d : {kWest, kEast, kUp, kDown, kNorth, kSouth}) {
    expect_at(v, d, 5, 10 * k + 5);
    expect_at(h, d, 10 * k + 5, 5);
    ++k;
  }
}

// The corners of each face by the numbering in OpenEXR's ImfEnvmap.h: bit 0 is +X, bit 1 is +Y,
// bit 2 is +Z; in reading order upper left, upper right, lower left, lower right.
TEST(Orientation, CubeFacesHaveOpenExrsCorners) {
  const int corners[6][4] = {{3, 7, 1, 5}, {6, 2, 4, 0}, {6, 7, 2, 3},
                             {0, 1, 4, 5}, {7, 6, 5, 4}, {2, 3, 0, 1}};
  const Camera c = make_camera(Projection::cube, 10, 60, {});
  for (int face = 0; face < 6; ++face)
    for (int k = 0; k < 4; ++k) {
      const double x = k % 2 == 0 ? 1e-6 : 10 - 1e-6, y = k / 2 == 0 ? 1e-6 : 10 - 1e-6;
      const auto d = direction_at(c, {x, 10 * face + y});
      const int n = corners[face][k];
      // X = west, Y = up, Z = north.
      const double third = 1 / std::sqrt(3.0);
      EXPECT_NEAR(-d->x(), n & 1 ? third : -third, 1e-6) << face << ' ' << k;
      EXPECT_NEAR(d->z(), n & 2 ? third : -third, 1e-6) << face << ' ' << k;
      EXPECT_NEAR(d->y(), n & 4 ? third : -third, 1e-6) << face << ' ' << k;
    }
}

TEST(Orientation, CrossShowsTheHeadingInItsSecondColumnAndEastToTheRight) {
  const Camera c =
      make_camera(Projection::cube, 40, 30, {}, look_at({}, {}, {}), CubeLayout::cross);
  expect_at(c, kWest, 5, 15);
  expect_at(c, kNorth, 15, 15);
  expect_at(c, kEast, 25, 15);
  expect_at(c, kSouth, 35, 15);
  expect_at(c, kUp, 15, 5);
  expect_at(c, kDown, 15, 25);
  for (const PixelPosition blank : {PixelPosition{5, 5}, {25, 5}, {35, 25}, {5, 29}})
    EXPECT_FALSE(direction_at(c, blank));
  EXPECT_EQ(pixel_solid_angle(c, 0, 0).in(sr), 0);
}

TEST(CubeFaces, TogetherShareTheirEdges) {
  // Each edge position of each face shows exactly (power-of-two face) a position of another face.
  const Camera c = make_camera(Projection::cube, 16, 96, {});
  for (const CubeFace face : kCubeFaces)
    for (int k = 1; k < 16; ++k)
      for (const PixelPosition local :
           {PixelPosition{0, double(k)}, {16, double(k)}, {double(k), 0}, {double(k), 16}}) {
        const auto [x0, y0] = cube_face_origin(c, face);
        const auto d = cube_ray(c, face, {x0 + local.x, y0 + local.y});
        int shared_with = 0;
        for (const CubeFace other : kCubeFaces) {
          if (other == face) continue;
          for (int j = 1; j < 16; ++j)
            for (const PixelPosition q :
                 {PixelPosition{0, double(j)}, {16, double(j)}, {double(j), 0}, {double(j), 16}}) {
              const auto [u0, v0] = cube_face_origin(c, other);
              shared_with += cube_ray(c, other, {u0 + q.x, v0 + q.y}).vec() == d.vec();
            }
        }
        ASSERT_EQ(shared_with, 1) << int(face) << ' ' << local.x << ' ' << local.y;
      }
}

TEST(CubeFaces, OfTheCrossJoinWhereTheyTouch) {
  const Camera c =
      make_camera(Projection::cube, 64, 48, {}, look_at(30 * deg, {}, {}), CubeLayout::cross);
  const auto expect_joined = [&](PixelPosition a, PixelPosition b) {
    EXPECT_LT(separation(*direction_at(c, a), *direction_at(c, b)).in(rad), 1e-6);
  };
  for (double t = 0.5; t < 16; ++t) {
    for (const double x : {16.0, 32.0, 48.0}) expect_joined({x - 1e-7, 16 + t}, {x, 16 + t});
    for (const double y : {16.0, 32.0}) expect_joined({16 + t, y - 1e-7}, {16 + t, y});
    expect_joined({0, 16 + t}, {64, 16 + t});  // the row closes
  }
}

}  // namespace
}  // namespace skylapse::image
