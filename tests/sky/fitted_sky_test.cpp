#include "sky/fitted_sky.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/constants.h"
#include "core/parallel.h"
#include "sky/cie/sky.h"
#include "sky/preetham/sky.h"

namespace skylapse::sky {
namespace {

image::Camera map(int width) {
  image::Camera camera;
  camera.projection = image::Projection::lat_long;
  camera.width = width, camera.height = width / 2;
  return camera;
}

TEST(FittedSky, IrradianceIsThatOfThePicture) {
  const Direction<Enu> sun = enu_direction(120 * deg, 40 * deg);
  const auto preetham = preetham::make_sky(2.5, sun, 0.27 * deg);
  const auto cie = cie::make_sky(12, 2.5, sun, 0.27 * deg);
  ASSERT_TRUE(preetham.ok() && cie.ok());
  for (const FittedSky* sky : {&*preetham, &*cie}) {
    const image::Camera camera = map(256);
    image::FrameBuffer picture(camera.width, camera.height);
    render_dome(camera, sky->dome, glm::dmat3(1), glm::dvec3(0), picture);
    glm::dvec3 sum{0};
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x) {
        const auto d = image::direction_at(camera, {x + 0.5, y + 0.5});
        if (d->z() <= 0) continue;
        const float* p = picture.pixel(x, y);
        sum += d->z() * image::pixel_solid_angle(camera, x, y).in(sr)*glm::dvec3(p[0], p[1], p[2]);
      }
    const glm::dvec3 irradiance = dome_irradiance(sky->dome);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / irradiance[c], 1, 1e-3);
  }
}

TEST(FittedSky, PicturesAreTheSameOnAnyNumberOfThreads) {
  const auto sky = preetham::make_sky(3, enu_direction(10 * deg, 20 * deg), 0.27 * deg);
  ASSERT_TRUE(sky.ok());
  const image::Camera camera = map(64);
  image::FrameBuffer alone(64, 32), together(64, 32);
  {
    const ThreadLimit one(1);
    render_dome(camera, sky->dome, glm::dmat3(1), glm::dvec3(0.1), alone);
  }
  render_dome(camera, sky->dome, glm::dmat3(1), glm::dvec3(0.1), together);
  EXPECT_EQ(alone.data(), together.data());
}

TEST(FittedSky, TheSunBringsWhatTheFormulaOfItsBeamSays) {
  // Above the air 133 klx; at noon through clear air some 100.
  const auto sky = preetham::make_sky(2, enu_direction(0 * deg, 90 * deg), 0.27 * deg);
  ASSERT_TRUE(sky.ok());
  const double lux = disc_energy(sky->disc).normal_irradiance.y * kLuminousEfficacy;
  EXPECT_GT(lux, 98e3);
  EXPECT_LT(lux, 112e3);
  const auto open = dimmed_disc(enu_direction(0 * deg, 90 * deg), 0.27 * deg,
                                [](Wavelength, Angle) { return 1.0; });
  EXPECT_NEAR(disc_energy(open).normal_irradiance.y * kLuminousEfficacy, 133e3, 2e3);
}

TEST(FittedSky, GroundReflectsDomeAndDisc) {
  const auto sky = cie::make_sky(5, 2.5, enu_direction(0 * deg, 50 * deg), 0.27 * deg);
  ASSERT_TRUE(sky.ok());
  const glm::dvec3 irradiance = dome_irradiance(sky->dome);
  const double expected = 0.2 * 133800 * std::sin(50 * deg.factor) * 0.5 / std::numbers::pi;
  EXPECT_NEAR(ground_radiance(*sky, irradiance, 0.5).y * kLuminousEfficacy, expected,
              1e-3 * expected);
}

}  // namespace
}  // namespace skylapse::sky
