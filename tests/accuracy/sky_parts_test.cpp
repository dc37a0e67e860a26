// How a picture's sky is shared out.
#include <gtest/gtest.h>

#include <numeric>

#include "plan/sky_parts.h"

namespace skylapse::plan {
namespace {

double sum(const PartShares& shares) { return std::accumulate(shares.begin(), shares.end(), 0.0); }

TEST(SkyParts, WholeSkyHasTheSolidAngleOfItsBands) {
  image::Camera map;
  map.projection = image::Projection::lat_long;
  map.width = 720, map.height = 360;
  const auto sun = enu_direction(0 * deg, -30 * deg);  // no aureole above the horizon
  const PartShares shares = CameraSky(map).shares(sun, 0 * deg);
  EXPECT_NEAR(sum(shares), 1, 1e-12);
  // Of a hemisphere a band of elevations has the difference of their sines; the looks of a camera
  // are 9 deg apart here, so that bands of 5 and 20 deg are met roughly.
  EXPECT_EQ(shares[size_t(SkyPart::aureole)], 0);
  EXPECT_NEAR(shares[size_t(SkyPart::high)], 1 - sin(25 * deg), 0.1);
  EXPECT_NEAR(shares[size_t(SkyPart::low_sunward)], shares[size_t(SkyPart::low_away)], 1e-9);
}

TEST(SkyParts, TelescopeAtTheSunSeesTheAureoleAlone) {
  image::Camera camera;
  camera.width = camera.height = 100;
  camera.field_of_view = 5 * deg;
  camera.camera_to_enu = image::look_at(40 * deg, 30 * deg, 0 * deg);
  const auto shares = CameraSky(camera).shares(enu_direction(40 * deg, 30 * deg), 0 * deg);
  EXPECT_NEAR(shares[size_t(SkyPart::aureole)], 1, 1e-12);
}

TEST(SkyParts, CameraThatLooksDownSeesNoSky) {
  image::Camera camera;
  camera.width = camera.height = 1;
  camera.field_of_view = 20 * deg;
  camera.camera_to_enu = image::look_at(0 * deg, -60 * deg, 0 * deg);
  EXPECT_EQ(sum(CameraSky(camera).shares(enu_direction(0 * deg, 30 * deg), 0 * deg)), 0);
}

TEST(SkyParts, SunInTheZenithLeavesNoDirectionOut) {
  const auto sun = enu_direction(0 * deg, 90 * deg);
  for (int azimuth = 0; azimuth < 360; azimuth += 15)
    for (int elevation = 0; elevation <= 90; elevation += 5)
      EXPECT_TRUE(part_of(enu_direction(azimuth * deg, elevation * deg), sun, -1e-9 * deg));
  EXPECT_FALSE(part_of(enu_direction(0 * deg, -1 * deg), sun, 0 * deg));
}

TEST(SkyParts, ThinLimbFromOrbitIsSeenByAMap) {
  image::Camera map;
  map.projection = image::Projection::lat_long;
  map.width = 512, map.height = 256;  // looks of 9 deg pass by a ring of 3 deg
  const auto sun = enu_direction(180 * deg, -40 * deg);
  const auto shares = CameraSky(map).shares(sun, -19.8 * deg, -16.9 * deg);
  EXPECT_NEAR(shares[size_t(SkyPart::horizon_away)], 0.5, 0.02);
  EXPECT_NEAR(shares[size_t(SkyPart::horizon_sunward)], 0.5, 0.02);
}

TEST(SkyParts, BlackSpaceAboveTheAirDoesNotCount) {
  image::Camera camera;
  camera.width = camera.height = 200;
  camera.field_of_view = 60 * deg;
  camera.camera_to_enu = image::look_at(0 * deg, -15 * deg, 0 * deg);
  const auto shares =
      CameraSky(camera).shares(enu_direction(180 * deg, 20 * deg), -20 * deg, -16 * deg);
  EXPECT_NEAR(shares[size_t(SkyPart::horizon_away)], 1, 1e-12);
}

}  // namespace
}  // namespace skylapse::plan
