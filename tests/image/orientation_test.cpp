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

TEST(Orientation, VerticalCrossShowsTheHeadingInItsSecondRowAndWhatIsBehindBelow) {
  const Camera c =
      make_camera(Projection::cube, 30, 40, {}, look_at({}, {}, {}), CubeLayout::vertical_cross);
  expect_at(c, kWest, 5, 15);
  expect_at(c, kNorth, 15, 15);
  expect_at(c, kEast, 25, 15);
  expect_at(c, kUp, 15, 5);
  expect_at(c, kDown, 15, 25);
  expect_at(c, kSouth, 15, 35);
  // Upside down: the sky is below, and east, seen from there to the left, to the right.
  EXPECT_GT(position_of(c, enu_direction(180 * deg, 20 * deg))->y, 35);
  EXPECT_GT(position_of(c, enu_direction(160 * deg, {}))->x, 15);
  for (const PixelPosition blank : {PixelPosition{5, 5}, {25, 5}, {5, 25}, {5, 35}, {29, 39}})
    EXPECT_FALSE(direction_at(c, blank));
}

// pbrt-4's EqualAreaSquareToSphere with its x, y, z as east, north, up.
TEST(Orientation, OctahedralHasTheZenithInTheMiddleAndNorthBelow) {
  const Camera c = make_camera(Projection::octahedral, 100, 100, {});
  expect_at(c, kUp, 50, 50);
  expect_at(c, kEast, 100, 50);
  expect_at(c, kWest, 0, 50);
  expect_at(c, kNorth, 50, 100);
  expect_at(c, kSouth, 50, 0);
  for (const double x : {1e-6, 100 - 1e-6})
    for (const double y : {1e-6, 100 - 1e-6}) EXPECT_LT(direction_at(c, {x, y})->z(), -1 + 1e-12);
  // Half way to the edge: r = 1/2, z = 1 - r^2.
  EXPECT_NEAR(direction_at(c, {75, 50})->z(), 0.75, 1e-15);
  EXPECT_NEAR(direction_at(c, {75, 75})->z(), 0, 1e-15);  // north-east, on the horizon
  EXPECT_NEAR(azimuth(*direction_at(c, {75, 75})).in(deg), 45, 1e-12);
}

TEST(Orientation, OctahedralTurnsWithItsHeading) {
  const Camera c = make_camera(Projection::octahedral, 100, 100, {}, look_at(90 * deg, {}, {}));
  expect_at(c, kEast, 50, 100);
  expect_at(c, kSouth, 100, 50);
}

TEST(Orientation, OctahedralEdgesAreFoldedInTheirMiddles) {
  const Camera c = make_camera(Projection::octahedral, 64, 64, {}, look_at(10 * deg, {}, {}));
  for (double t = 0.25; t < 64; t += 0.5) {
    const auto same = [&](PixelPosition a, PixelPosition b) {
      EXPECT_LT(separation(*direction_at(c, a), *direction_at(c, b)).in(rad), 1e-12) << t;
    };
    same({0, t}, {0, 64 - t});
    same({64, t}, {64, 64 - t});
    same({t, 0}, {64 - t, 0});
    same({t, 64}, {64 - t, 64});
  }
}

// The ball stands to the north of the camera: its middle shows the camera's own side.
TEST(Orientation, MirrorBallShowsWhatIsBehindInTheMiddleAndIsMirrored) {
  const Camera c = make_camera(Projection::mirror_ball, 200, 200, {});
  expect_at(c, kSouth, 100, 100);
  const double r = 100 * std::sqrt(0.5);  // the normal leans 45 deg
  expect_at(c, kEast, 100 + r, 100);
  expect_at(c, kWest, 100 - r, 100);
  expect_at(c, kUp, 100, 100 - r);
  expect_at(c, kDown, 100, 100 + r);
  // The rim is the one direction that the ball hides.
  for (int i = 0; i < 12; ++i) {
    const Angle a = i * 30 * deg;
    const auto d = direction_at(c, {100 + 100 * cos(a), 100 + 100 * sin(a)});
    EXPECT_LT(separation(*d, kNorth).in(rad), 1e-3) << i;
  }
  EXPECT_FALSE(direction_at(c, {5, 5}));
  // Law of reflection on the ball, for a ray that flies north.
  for (const auto& [x, y] : {std::pair{0.3, 0.2}, {-0.6, 0.7}, {0.1, -0.9}}) {
    const glm::dvec3 n{x, -std::sqrt(1 - x * x - y * y), y}, ray{0, 1, 0};
    const auto d = direction_at(c, {100 + 100 * x, 100 - 100 * y});
    EXPECT_LT(glm::length(d->vec() - (ray - 2 * glm::dot(ray, n) * n)), 1e-12);
  }
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

TEST(CubeFaces, OfTheVerticalCrossJoinWhereTheyTouch) {
  const Camera c = make_camera(Projection::cube, 48, 64, {}, look_at(30 * deg, {}, {}),
                               CubeLayout::vertical_cross);
  const auto expect_joined = [&](PixelPosition a, PixelPosition b) {
    EXPECT_LT(separation(*direction_at(c, a), *direction_at(c, b)).in(rad), 1e-6);
  };
  for (double t = 0.5; t < 16; ++t) {
    for (const double x : {16.0, 32.0}) expect_joined({x - 1e-7, 16 + t}, {x, 16 + t});
    for (const double y : {16.0, 32.0, 48.0}) expect_joined({16 + t, y - 1e-7}, {16 + t, y});
    expect_joined({16 + t, 0}, {16 + t, 64});  // the column closes
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
