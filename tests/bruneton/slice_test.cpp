// Slices of the twin.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "bruneton/twins.h"
#include "sky/bruneton/rays.h"
#include "sky/bruneton/slice_refine.h"

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

/// Errors of a frame's slice against marching, relative, of values above 0.1 % of the brightest: a
/// third of the directions near the horizon, on either side of it.
std::vector<double> slice_errors(Length height, Angle sun) {
  MarchSettings march;
  march.ground = true;
  const SliceGrid grid = slice_grid(twin().medium(), height);
  const SkySlice slice = refined(twin().slice(height, sun, grid, march));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<std::pair<double, double>> values;
  double brightest = 0;
  for (int i = 0; i < 300; ++i) {
    const double s = (i % 3 == 0 ? 0.2 : 1.0) * share(random);
    const double span = i % 2 == 0 ? grid.sky_span_rad : -grid.ground_span_rad;
    const Angle zenith = (grid.horizon_zenith_rad - span * s * s) * rad;
    const Angle azimuth = text::PI * share(random) * rad;
    const double direct = twin().answer({height, sun, zenith, azimuth}, march).radiance[0];
    values.push_back({slice.radiance_xyz(zenith, azimuth).y, direct});
    brightest = std::max(brightest, direct);
  }
  std::vector<double> errors;
  for (const auto& [value, direct] : values)
    if (direct > 1e-3 * brightest) errors.push_back(std::abs(value / direct - 1));
  std::sort(errors.begin(), errors.end());
  return errors;
}

TEST(Slice, OfAFrameIsWithinOneAndAHalfPercentOfMarchingUpToFortyKilometres) {
  // A step of an 8-bit sRGB picture is 1.7 % of the radiance at mid-grey: the worst stays below it,
  // the rest well below. At 40 km the limb has few rows.
  struct Bound {
    double height_km, p99, most;
  };
  for (const Bound& bound : {Bound{0.001, 0.003, 0.01},
                             {0.05, 0.003, 0.01},
                             {3, 0.005, 0.01},
                             {11, 0.005, 0.01},
                             {40, 0.01, 0.015}})
    for (const double sun : {30.0, 90.0, 96.0}) {
      const std::vector<double> errors = slice_errors(bound.height_km * km, sun * deg);
      EXPECT_LT(errors[errors.size() * 99 / 100], bound.p99) << bound.height_km << ' ' << sun;
      EXPECT_LT(errors.back(), bound.most) << bound.height_km << ' ' << sun;
    }
}

TEST(Slice, OfAFrameFromOrbitIsWithinTwoPercentOfMarchingUpToTheTerminator) {
  // Light falls tenfold within two degrees there: two percent are a fiftieth of a degree.
  for (const double sun : {30.0, 90.0, 96.0}) {
    const std::vector<double> errors = slice_errors(400 * km, sun * deg);
    EXPECT_LT(errors[errors.size() * 99 / 100], 0.02) << sun;
    EXPECT_LT(errors.back(), 0.06) << sun;
  }
}

TEST(SliceGrid, ElevationAndShareAreInverse) {
  for (const double height : {0.0, 0.001, 10.0, 400.0, 36000.0}) {
    const SliceGrid grid = slice_grid(green_medium(), height * km);
    for (const bool sky : {true, false})
      for (double s = 0; s <= 1; s += 0.0625) {
        const double e = grid.elevation(s, sky);
        EXPECT_NEAR(grid.share(sky ? e : -e), s, 1e-9) << height;
      }
  }
}

/// A slice whose texels are f(azimuth coordinate, row of its half, half) in all components.
template <class F>
SkySlice slice_of(int azimuths, int zeniths, F f) {
  SkySlice slice;
  slice.grid = slice_grid(green_medium(), 2 * metre, azimuths, zeniths);
  for (int j = 0; j < zeniths; ++j)
    for (int i = 0; i < azimuths; ++i) {
      const auto value = float(f(i, j % (zeniths / 2), j < zeniths / 2));
      slice.smooth.emplace_back(value, value, value, 0.0f);
      slice.aerosol.push_back(2.0f * slice.smooth.back());
    }
  return slice;
}

TEST(RefinedSlice, KeepsItsNodesAndItsHalvesApart) {
  const SkySlice slice = slice_of(
      5, 12, [](int i, int j, bool sky) { return (sky ? 1 : 1e-6) * (1 + (i * 7 + j * 5) % 11); });
  const SkySlice fine = refined(slice, {2, 3});
  EXPECT_EQ(fine.grid.azimuths, 9);
  EXPECT_EQ(fine.grid.zeniths, 32);
  for (int half = 0; half < 2; ++half)
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 5; ++i)
        EXPECT_EQ(fine.smooth[size_t(half * 16 + 3 * j) * 9 + 2 * i].x,
                  slice.smooth[size_t(half * 6 + j) * 5 + i].x);
  for (size_t i = 0; i < fine.smooth.size(); ++i) {
    if (i < 16 * 9)
      EXPECT_GT(fine.smooth[i].y, 0.5);
    else
      EXPECT_LT(fine.smooth[i].y, 2e-5);
  }
}

TEST(RefinedSlice, FollowsAnExponentialFallExactly) {
  const SkySlice fine =
      refined(slice_of(4, 16, [](int, int j, bool) { return std::exp(-1.3 * j); }), {2, 4});
  for (int j = 0; j < fine.grid.zeniths / 2; ++j)
    EXPECT_NEAR(fine.aerosol[size_t(j) * fine.grid.azimuths + 3].z / (2 * std::exp(-1.3 * j / 4)),
                1, 3e-6)
        << j;
}

TEST(RefinedSlice, NeitherRingsNorTurnsNegativeAtAnEdgeIntoBlack) {
  // At a crest of the logarithm the curve may rise by a quarter of a slope of 0.15, on either axis.
  const double crest = std::exp(2 * 0.15 / 4);
  for (const double dark : {0.0, 1e-20, 1e-3}) {
    const SkySlice fine = refined(
        slice_of(8, 24, [&](int i, int j, bool) { return i + j < 9 ? 1.0 : dark; }), {3, 3});
    for (const glm::vec4& texel : fine.smooth) {
      EXPECT_GE(texel.x, (1 - 1e-6) * dark / crest);
      EXPECT_LE(texel.x, crest);
    }
  }
}

TEST(RefinedSlice, ByOneIsTheSliceItself) {
  const SkySlice slice = slice_of(5, 12, [](int i, int j, bool) { return 1 + i * j; });
  const SkySlice same = refined(slice, {1, 1});
  EXPECT_EQ(same.grid, slice.grid);
  EXPECT_EQ(same.smooth, slice.smooth);
  EXPECT_EQ(same.aerosol, slice.aerosol);
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
