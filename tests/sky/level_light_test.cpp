#include "sky/level_light.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "image/irradiance.h"

namespace skylapse::sky {
namespace {

using image::Projection;

image::Camera camera_of(Projection projection, int width, int height) {
  image::Camera camera;
  camera.projection = projection;
  camera.width = width, camera.height = height;
  return camera;
}

std::vector<image::Camera> coarse_cameras() {
  return {camera_of(Projection::lat_long, 64, 32), camera_of(Projection::lat_long, 101, 50),
          camera_of(Projection::cube, 16, 96), camera_of(Projection::octahedral, 64, 64),
          camera_of(Projection::mirror_ball, 96, 96)};
}

/// A red sun of even light.
SunDisc sun_at(Angle elevation, Angle horizon = {}) {
  SunDisc disc{enu_direction(120 * deg, elevation), 0.27 * deg,
               [](Angle, double) { return glm::dvec3(3e5, 1e5, 1e3); }};
  disc.horizon = horizon;
  return disc;
}

image::FrameBuffer picture_of(const image::Camera& camera, const ProjectedDisc& projected) {
  image::FrameBuffer picture(camera.width, camera.height);
  add_rows(projected, 0, picture);
  return picture;
}

TEST(LevelLight, ALowDiscInCoarsePixelsKeepsItsFluxAndTheGroundsIrradiance) {
  for (const image::Camera& camera : coarse_cameras())
    for (const double elevation : {-0.1, 0.0, 0.3, 1.0, 2.0, 3.5}) {
      const SunDisc disc = sun_at(elevation * deg);
      const DiscEnergy truth = disc_energy(disc);
      auto projected = project_sun_disc(camera, disc);
      sink_to_level(camera, truth.horizontal_irradiance, projected);
      const auto flux = image::image_flux(camera, picture_of(camera, projected));
      for (int c = 0; c < 3; ++c) {
        // Floats of the picture.
        EXPECT_NEAR(flux.total[c] / truth.normal_irradiance[c], 1, 1e-6) << elevation;
        EXPECT_LT(flux.horizontal_irradiance[c],
                  truth.horizontal_irradiance[c] + 1e-6 * truth.normal_irradiance[c])
            << int(camera.projection) << " " << elevation;
      }
    }
}

TEST(LevelLight, ALatLongMapGivesTheGroundAllOfALowDiscsLight) {
  const auto camera = camera_of(Projection::lat_long, 64, 32);
  for (const double elevation : {0.3, 1.0, 2.0, 5.0}) {
    const SunDisc disc = sun_at(elevation * deg);
    const DiscEnergy truth = disc_energy(disc);
    auto projected = project_sun_disc(camera, disc);
    sink_to_level(camera, truth.horizontal_irradiance, projected);
    const auto flux = image::image_flux(camera, picture_of(camera, projected));
    EXPECT_NEAR(flux.horizontal_irradiance.x / truth.horizontal_irradiance.x, 1, 1e-5) << elevation;
    EXPECT_NEAR(projected.energy.horizontal_irradiance.x / truth.horizontal_irradiance.x, 1, 1e-9);
  }
}

TEST(LevelLight, NothingHappensToLightThatIsWithinItsMeasure) {
  const auto camera = camera_of(Projection::lat_long, 64, 32);
  const SunDisc disc = sun_at(0.5 * deg);
  const auto before = project_sun_disc(camera, disc);
  auto after = before;
  sink_to_level(camera, before.energy.horizontal_irradiance, after);
  EXPECT_EQ(picture_of(camera, after).data(), picture_of(camera, before).data());
}

TEST(LevelLight, EachPixelComesOnceInReadingOrder) {
  const auto camera = camera_of(Projection::cube, 16, 96);
  auto projected = project_sun_disc(camera, sun_at(0.5 * deg));
  sink_to_level(camera, glm::dvec3(0), projected);
  EXPECT_TRUE(std::is_sorted(projected.pixels.begin(), projected.pixels.end(),
                             [](const PixelAddition& a, const PixelAddition& b) {
                               return std::pair(a.y, a.x) < std::pair(b.y, b.x);
                             }));
  for (size_t i = 1; i < projected.pixels.size(); ++i)
    EXPECT_FALSE(projected.pixels[i].x == projected.pixels[i - 1].x &&
                 projected.pixels[i].y == projected.pixels[i - 1].y);
}

/// From a height: the horizon is dipped, so the pixels below the level hold sky.
TEST(LevelLight, ADiscBelowTheLevelButAboveADippedHorizonLeavesLevelGroundDark) {
  const auto camera = camera_of(Projection::lat_long, 256, 128);
  const SunDisc disc = sun_at(-0.6 * deg, -5 * deg);
  const DiscEnergy truth = disc_energy(disc);
  ASSERT_EQ(truth.horizontal_irradiance.x, 0);
  auto projected = project_sun_disc(camera, disc);
  ASSERT_GT(projected.energy.horizontal_irradiance.x, 0);
  sink_to_level(camera, truth.horizontal_irradiance, projected);
  const auto flux = image::image_flux(camera, picture_of(camera, projected));
  EXPECT_NEAR(flux.total.x / truth.normal_irradiance.x, 1, 1e-6);
  EXPECT_LT(flux.horizontal_irradiance.x, 1e-9 * flux.total.x);
}

TEST(LevelLight, APictureKeepsItsFluxAndGivesTheGroundWhatItShould) {
  for (const image::Camera& camera : coarse_cameras()) {
    image::FrameBuffer picture(camera.width, camera.height);
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x)
        if (image::direction_at(camera, {x + 0.5, y + 0.5}))
          for (int c = 0; c < 3; ++c) picture.pixel(x, y)[c] = float(1 + c + x % 3);
    const auto before = image::image_flux(camera, picture);
    const glm::dvec3 most = 0.998 * before.horizontal_irradiance;
    sink_to_level(camera, most, picture);
    const auto after = image::image_flux(camera, picture);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(after.total[c] / before.total[c], 1, 1e-6);
      EXPECT_NEAR(after.horizontal_irradiance[c] / most[c], 1, 1e-6) << int(camera.projection);
    }
  }
}

}  // namespace
}  // namespace skylapse::sky
