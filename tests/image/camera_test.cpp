#include "image/camera/camera.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "image/camera/cube.h"
#include "image/camera/fisheye.h"
#include "sample_cameras.h"

namespace skylapse::image {
namespace {

constexpr double kPi = std::numbers::pi;

class EveryCamera : public testing::TestWithParam<NamedCamera> {};
INSTANTIATE_TEST_SUITE_P(Camera, EveryCamera, testing::ValuesIn(sample_cameras()),
                         [](const auto& param) { return param.param.name; });

TEST_P(EveryCamera, PositionOfTheDirectionAtAPixelIsThePixel) {
  const Camera& c = GetParam().camera;
  int seen = 0;
  for (int y = 0; y < c.height; ++y)
    for (int x = 0; x < c.width; ++x) {
      const auto d = direction_at(c, {x + 0.5, y + 0.5});
      if (!d) continue;
      ++seen;
      const auto p = position_of(c, *d);
      ASSERT_TRUE(p) << x << ' ' << y;
      // Rounding of the direction (1e-16 rad) times pixels per radian; the equisolid lens has an
      // infinite scale at its 360 degree rim.
      ASSERT_NEAR(p->x, x + 0.5, 1e-9) << x << ' ' << y;
      ASSERT_NEAR(p->y, y + 0.5, 1e-9) << x << ' ' << y;
    }
  EXPECT_GT(seen, c.width * c.height / 3);
}

TEST_P(EveryCamera, DirectionAtThePositionOfADirectionIsTheDirection) {
  const Camera& c = GetParam().camera;
  std::mt19937 rng(7);
  std::normal_distribution<double> normal;
  int seen = 0;
  for (int i = 0; i < 20000; ++i) {
    const bool narrow = c.projection == Projection::perspective;
    const double spread = narrow ? 0.2 * c.field_of_view.in(rad) : 50;
    const glm::dvec3 ahead = c.camera_to_enu[2];
    const auto d = Direction<Enu>::from_vector(
        ahead + spread * glm::dvec3{normal(rng), normal(rng), normal(rng)});
    const auto p = position_of(c, d);
    if (!p) continue;
    ++seen;
    ASSERT_GE(p->x, 0);
    ASSERT_LE(p->x, c.width);
    ASSERT_GE(p->y, 0);
    ASSERT_LE(p->y, c.height);
    const auto back = direction_at(c, *p);
    ASSERT_TRUE(back);
    ASSERT_LT(separation(d, *back).in(arcsec), 1e-6);
  }
  EXPECT_GT(seen, 1000);
}

TEST_P(EveryCamera, NothingIsSeenOutsideTheFrameOrAtNaN) {
  const Camera& c = GetParam().camera;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const PixelPosition p : {PixelPosition{-0.01, 3},
                                {3, -0.01},
                                {c.width + 0.01, 3},
                                {3, c.height + 0.01},
                                {nan, 3},
                                {3, nan},
                                {inf, 3},
                                {3, -inf}})
    EXPECT_FALSE(direction_at(c, p)) << p.x << ' ' << p.y;
  EXPECT_EQ(pixel_solid_angle(c, -1, 0).in(sr), 0);
  EXPECT_EQ(pixel_solid_angle(c, 0, c.height).in(sr), 0);
}

// Small quadrilateral between the pixel's corners against pixel_solid_angle, as a check of the
// analytic solid angles by the directions alone.
TEST_P(EveryCamera, SolidAngleOfAPixelAgreesWithItsCorners) {
  const Camera& c = GetParam().camera;
  const auto triangle = [](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r) {
    return 2 * std::atan2(std::abs(glm::dot(p, glm::cross(q, r))),
                          1 + glm::dot(p, q) + glm::dot(q, r) + glm::dot(r, p));  // van Oosterom
  };
  std::mt19937 rng(3);
  int checked = 0;
  for (int i = 0; i < 300; ++i) {
    const int x = int(rng() % c.width), y = int(rng() % c.height);
    // At its 360 degree rim the equisolid lens has an infinite scale: sides bend within a pixel.
    const bool rim = GetParam().name == "equisolid_full" || c.projection == Projection::mirror_ball;
    if (rim && fisheye_radius_at(c, {x + 0.5, y + 0.5}) > 0.96) continue;
    // The quadrilateral of an 8 x 8 part of the pixel: side lines are nearly great circles.
    double sum = 0;
    bool complete = true;
    for (int v = 0; v < 8 && complete; ++v)
      for (int u = 0; u < 8; ++u) {
        const auto corner = [&](int du, int dv) {
          return direction_at(c,
                              {x + (u + du) / 8.0 * (1 - 1e-9), y + (v + dv) / 8.0 * (1 - 1e-9)});
        };
        const auto a = corner(0, 0), b = corner(1, 0), d = corner(1, 1), e = corner(0, 1);
        complete = a && b && d && e;
        if (!complete) break;
        sum += triangle(a->vec(), b->vec(), d->vec()) + triangle(a->vec(), d->vec(), e->vec());
      }
    if (!complete) continue;
    ++checked;
    const double expected = pixel_solid_angle(c, x, y).in(sr);
    // The chords' deviation from the curved pixel sides falls with 1/64 of (pixel angle)^2; the
    // largest pixels here span 0.1 rad, rows at the poles of a lat-long map are triangles.
    EXPECT_NEAR(sum / expected, 1, 2e-3) << x << ' ' << y;
  }
  EXPECT_GT(checked, 50);
}

TEST_P(EveryCamera, NeighbouringPositionsShowNeighbouringDirections) {
  const Camera& c = GetParam().camera;
  const bool cube = c.projection == Projection::cube;
  for (int y = 0; y < c.height; y += 5)
    for (double x = 0; x < c.width; x += 1.7) {
      const PixelPosition p{x, y + 0.5}, q{x + 1e-6, y + 0.5};
      if (cube && cube_face_at(c, p) != cube_face_at(c, q)) continue;  // no neighbours in a strip
      const auto a = direction_at(c, p), b = direction_at(c, q);
      if (!a || !b) continue;
      ASSERT_LT(separation(*a, *b).in(rad), 3e-5) << x << ' ' << y;
    }
}

double sum_of_solid_angles(const Camera& c) {
  double sum = 0;
  for (int y = 0; y < c.height; ++y)
    for (int x = 0; x < c.width; ++x) sum += pixel_solid_angle(c, x, y).in(sr);
  return sum;
}

TEST(PixelSolidAngle, PixelsOfUprightMapsFillTheSphere) {
  for (const auto& [name, camera] : sample_cameras())
    if (stands_upright(camera.projection)) {
      EXPECT_NEAR(sum_of_solid_angles(camera) / (4 * kPi), 1, 1e-9) << name;
    }
  for (const int n : {1, 2, 3, 257}) {
    EXPECT_NEAR(sum_of_solid_angles(make_camera(Projection::cube, n, 6 * n, {})), 4 * kPi, 1e-7);
    EXPECT_NEAR(sum_of_solid_angles(make_camera(Projection::lat_long, n, n, {})), 4 * kPi, 1e-12);
    EXPECT_NEAR(sum_of_solid_angles(make_camera(Projection::octahedral, n, n, {})), 4 * kPi, 1e-10);
  }
}

TEST(PixelSolidAngle, PerspectivePixelsFillThePyramid) {
  for (const double fov : {0.01, 1.0, 60.0, 150.0, 179.0})
    for (const auto& [w, h] : {std::pair{1, 1}, {5, 3}, {160, 90}}) {
      const Camera c = make_camera(Projection::perspective, w, h, fov * deg);
      const double a = std::tan(fov / 2 * kPi / 180), b = a * h / w;
      const double pyramid = 4 * std::atan(a * b / std::sqrt(1 + a * a + b * b));
      EXPECT_NEAR(sum_of_solid_angles(c) / pyramid, 1, 1e-6) << fov << ' ' << w;
    }
}

// A fisheye's pixels are in or out as a whole. The count of lattice points in a circle of radius
// R pixels differs from its area by less than 3 R^(2/3) for the radii here.
TEST(PixelSolidAngle, FisheyePixelsFillTheCapButForTheCirclesEdge) {
  using enum Projection;
  for (const Projection p : {fisheye_equidistant, fisheye_equisolid, fisheye_stereographic})
    for (const double fov : {10.0, 120.0, 180.0, 300.0})
      for (const int size : {64, 255, 512}) {
        const Camera c = zenith_fisheye(p, size, fov * deg);
        const double cap = 2 * kPi * (1 - std::cos(fov / 2 * kPi / 180));
        const double edge_pixels = 3 * std::pow(size / 2.0, 2.0 / 3);
        const double edge_pixel = pixel_solid_angle(c, size / 2, 0).in(sr);
        EXPECT_NEAR(sum_of_solid_angles(c), cap, edge_pixels * edge_pixel) << fov << ' ' << size;
      }
}

TEST(PixelSolidAngle, EquisolidPixelsAreEqual) {
  const Camera c = zenith_fisheye(Projection::fisheye_equisolid, 100, 200 * deg);
  const double middle = pixel_solid_angle(c, 50, 50).in(sr);
  EXPECT_NEAR(pixel_solid_angle(c, 50, 2).in(sr) / middle, 1, 1e-12);
  EXPECT_EQ(pixel_solid_angle(c, 0, 0).in(sr), 0);
}

TEST(LookAt, AxesAreOrthonormalAndNotMirrored) {
  for (const double azimuth : {0.0, 33.0, 90.0, 359.0})
    for (const double elevation : {-90.0, -20.0, 0.0, 45.0, 90.0})
      for (const double roll : {0.0, 30.0, -180.0}) {
        const glm::dmat3 m = look_at(azimuth * deg, elevation * deg, roll * deg);
        const glm::dmat3 gram = glm::transpose(m) * m;
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) EXPECT_NEAR(gram[i][j], i == j, 1e-15);
        EXPECT_NEAR(glm::determinant(m), -1, 1e-15);
        EXPECT_NEAR(glm::dot(m[2], enu_direction(azimuth * deg, elevation * deg).vec()), 1, 1e-15);
      }
}

TEST(LookAt, RollIsClockwiseFromBehind) {
  const glm::dmat3 m = look_at({}, {}, 90 * deg);
  EXPECT_NEAR(m[0].z, -1, 1e-15);  // the right side goes down
  EXPECT_NEAR(m[1].x, 1, 1e-15);   // the upper edge goes east when facing north
}

TEST(LookAt, StraightUpKeepsTheLimitOfItsAzimuth) {
  for (const double azimuth : {0.0, 60.0, 270.0}) {
    const glm::dmat3 up = look_at(azimuth * deg, 90 * deg, {});
    const glm::dmat3 nearly = look_at(azimuth * deg, 89.9999999 * deg, {});
    for (int i = 0; i < 3; ++i) EXPECT_LT(glm::length(up[i] - nearly[i]), 1e-8);
  }
  EXPECT_NEAR(look_at({}, 90 * deg, {})[1].y, -1, 1e-15);  // facing north: south on top
  EXPECT_NEAR(look_at({}, -90 * deg, {})[1].y, 1, 1e-15);  // looking down: north on top
}

TEST(Fisheye, LensesFollowTheirFormulas) {
  using enum Projection;
  const double r = 0.6, half = 80 * kPi / 180;
  const auto theta = [&](Projection p) {
    return fisheye_theta(zenith_fisheye(p, 100, 160 * deg), r)->in(rad);
  };
  EXPECT_NEAR(theta(fisheye_equidistant), r * half, 1e-15);
  EXPECT_NEAR(std::sin(theta(fisheye_equisolid) / 2), r * std::sin(half / 2), 1e-15);
  EXPECT_NEAR(std::tan(theta(fisheye_stereographic) / 2), r * std::tan(half / 2), 1e-15);
}

TEST(Fisheye, TheRimShowsHalfTheFieldOfView) {
  using enum Projection;
  for (const Projection p : {fisheye_equidistant, fisheye_equisolid, fisheye_stereographic}) {
    const Camera c = zenith_fisheye(p, 100);
    for (int i = 0; i < 360; ++i) {
      const auto horizon = enu_direction(i * deg, {});
      const auto where = position_of(c, horizon);
      ASSERT_TRUE(where) << i;  // rounding must not push the horizon out of an all-sky image
      ASSERT_TRUE(direction_at(c, *where)) << i;
    }
    EXPECT_FALSE(position_of(c, enu_direction({}, -0.001 * deg)));
    EXPECT_FALSE(direction_at(c, {1, 1}));
  }
}

TEST(Perspective, DoesNotSeeWhatIsBehind) {
  const Camera c = make_camera(Projection::perspective, 10, 10, 170 * deg);
  EXPECT_FALSE(position_of(c, enu_direction(180 * deg, {})));
  EXPECT_FALSE(position_of(c, enu_direction(90 * deg, {})));
  EXPECT_TRUE(position_of(c, enu_direction(84 * deg, {})));
}

TEST(LatLong, PolesAndSeamHaveAPlace) {
  const Camera c = make_camera(Projection::lat_long, 8, 4, {});
  EXPECT_EQ(position_of(c, Direction<Enu>::from_vector({0, 0, 1}))->y, 0);
  const auto nadir = position_of(c, Direction<Enu>::from_vector({0, 0, -1}));
  EXPECT_EQ(nadir->y, 4);
  EXPECT_EQ(nadir->x, 4);
  EXPECT_NEAR(position_of(c, enu_direction(180.0001 * deg, {}))->x, 0, 1e-3);
  EXPECT_NEAR(position_of(c, enu_direction(179.9999 * deg, {}))->x, 8, 1e-3);
}

TEST(OnePixelImage, SeesSomethingInEveryProjection) {
  for (auto [name, camera] : sample_cameras()) {
    camera.width = camera.height = 1;
    if (camera.projection == Projection::cube) continue;  // six pixels at least
    EXPECT_TRUE(direction_at(camera, {0.5, 0.5})) << name;
    EXPECT_GT(pixel_solid_angle(camera, 0, 0).in(sr), 0) << name;
  }
}

TEST(HorizonCoverage, FollowsTheHorizonOfAHighCamera) {
  const SolidAngle pixel = 1e-4 * sr;
  for (const double over : {-0.006, -0.002, 0.0, 0.003, 0.007})
    EXPECT_NEAR(horizon_coverage(-19.8 * deg + over * rad, pixel, -19.8 * deg),
                horizon_coverage(over * rad, pixel), 1e-12);
}

TEST(HorizonCoverage, GoesFromNoneToAllOverOnePixel) {
  const SolidAngle pixel = 1e-4 * sr;  // 0.01 rad wide
  EXPECT_EQ(horizon_coverage(-0.005 * rad, pixel), 0);
  EXPECT_DOUBLE_EQ(horizon_coverage(0 * rad, pixel), 0.5);
  EXPECT_NEAR(horizon_coverage(0.0025 * rad, pixel), 0.75, 1e-12);
  EXPECT_EQ(horizon_coverage(0.006 * rad, pixel), 1);
  EXPECT_EQ(horizon_coverage(1 * deg, {}), 1);
  EXPECT_EQ(horizon_coverage(-1 * deg, {}), 0);
}

TEST(LookOf, IsTheInverseOfLookAtPolesIncluded) {
  for (const double azimuth : {0.0, 90.0, 200.0, 359.9})
    for (const double elevation : {-90.0, -89.9999, -20.0, 0.0, 45.0, 89.9999, 90.0})
      for (const double roll : {-170.0, 0.0, 30.0, 180.0}) {
        const glm::dmat3 axes = look_at(azimuth * deg, elevation * deg, roll * deg);
        const Look look = look_of(axes);
        const glm::dmat3 again = look_at(look.azimuth, look.elevation, look.roll);
        for (int column = 0; column < 3; ++column)
          EXPECT_LT(glm::length(axes[column] - again[column]), 1e-9)
              << azimuth << " " << elevation << " " << roll;
      }
}

}  // namespace
}  // namespace skylapse::image
