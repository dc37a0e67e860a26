// Slices of the twin.
#include <gtest/gtest.h>

#include <cmath>

#include "bruneton/twins.h"
#include "sky/bruneton/rays.h"

namespace skylapse::sky::bruneton {
namespace {

const Twin& twin() {
  static const Twin twin = make_twin(green_medium());
  return twin;
}

TEST(SliceGrid, SpansSkyAndGround) {
  const atmosphere::Medium medium = green_medium();
  for (const double height : {0.0, 0.002, 10.0, 60.0}) {
    const SliceGrid grid = slice_grid(medium, height * km);
    EXPECT_NEAR(slice_zenith(grid, 0), grid.horizon_zenith_rad, 1e-15);
    EXPECT_NEAR(slice_zenith(grid, grid.zeniths / 2 - 1), 0, 1e-12);
    EXPECT_NEAR(slice_zenith(grid, grid.zeniths / 2), grid.horizon_zenith_rad, 1e-15);
    EXPECT_NEAR(slice_zenith(grid, grid.zeniths - 1), text::PI, 1e-12);
  }
  const SliceGrid orbit = slice_grid(medium, 400 * km);
  EXPECT_NEAR(orbit.horizon_zenith_rad, text::PI - std::asin(6360.0 / 6760), 1e-12);
  EXPECT_NEAR(slice_zenith(orbit, orbit.zeniths / 2 - 1), text::PI - std::asin(6420.0 / 6760),
              1e-12);
}

TEST(Slice, HoldsTheAnswersOfItsNodes) {
  MarchSettings march;
  march.ground = true;
  for (const double height : {0.002, 10.0, 400.0})
    for (const double sun : {40.0, 92.0}) {
      const SliceGrid grid = slice_grid(twin().medium(), height * km, 7, 12);
      const SkySlice slice = twin().slice(height * km, sun * deg, grid, march);
      for (int j = 0; j < grid.zeniths; ++j) {
        if (j == 0 || j == grid.zeniths / 2) continue;  // the horizon itself is on either side
        for (int i = 0; i < grid.azimuths; ++i) {
          const Angle zenith = slice_zenith(grid, j) * rad;
          const Angle azimuth = text::PI * std::pow(i / 6.0, 1.5) * rad;
          const double direct =
              twin().answer({height * km, sun * deg, zenith, azimuth}, march).radiance[0];
          EXPECT_NEAR(slice.radiance_xyz(zenith, azimuth).y, direct, 2e-5 * direct + 1e-12)
              << height << ' ' << sun << ' ' << j << ' ' << i;
        }
      }
    }
}

TEST(Slice, OfTheDefaultSizeIsWithinOnePercentBetweenItsNodes) {
  MarchSettings march;
  march.ground = true;
  const SkySlice slice =
      twin().slice(2 * metre, 30 * deg, slice_grid(twin().medium(), 2 * metre), march);
  for (double zenith = 0.5; zenith < 180; zenith += 7.3)
    for (double azimuth = 0.5; azimuth < 180; azimuth += 17.7) {
      const double direct =
          twin().answer({2 * metre, 30 * deg, zenith * deg, azimuth * deg}, march).radiance[0];
      EXPECT_NEAR(slice.radiance_xyz(zenith * deg, azimuth * deg).y / direct, 1, 0.01)
          << zenith << ' ' << azimuth;
    }
}

TEST(Slice, IsSymmetricAboutTheSun) {
  const SkySlice slice =
      twin().slice(2 * metre, 50 * deg, slice_grid(twin().medium(), 2 * metre, 16, 32));
  EXPECT_EQ(slice.radiance_xyz(60 * deg, 40 * deg), slice.radiance_xyz(60 * deg, -40 * deg));
  EXPECT_NEAR(slice.radiance_xyz(60 * deg, 40 * deg).y, slice.radiance_xyz(60 * deg, 400 * deg).y,
              1e-9);
}

TEST(Slice, OfACameraInSpaceIsBlackAboveTheAir) {
  const SkySlice slice =
      twin().slice(400 * km, 50 * deg, slice_grid(twin().medium(), 400 * km, 16, 32));
  EXPECT_EQ(slice.radiance_xyz(90 * deg, 0 * deg), glm::dvec3(0));
  EXPECT_GT(slice.radiance_xyz(180 * deg, 0 * deg).y, 0);
}

}  // namespace
}  // namespace skylapse::sky::bruneton
