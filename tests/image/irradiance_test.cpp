#include "image/irradiance.h"

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "sample_cameras.h"

namespace skylapse::image {
namespace {

constexpr double kPi = std::numbers::pi;

FrameBuffer uniform_image(const Camera& camera, float value) {
  FrameBuffer image(camera.width, camera.height);
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x)
      if (direction_at(camera, {x + 0.5, y + 0.5}))
        for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = value * float(c + 1);
  return image;
}

TEST(ImageIrradiance, OfAUniformSkyIsPiTimesItsRadiance) {
  using enum Projection;
  // The centre stands for the pixel: cosines err by (pixel angle)^2 / 8, rims by part of a pixel.
  const std::vector<NamedCamera> skies{
      {"lat_long", make_camera(lat_long, 512, 256, {})},
      {"cube", make_camera(cube, 128, 768, {})},
      {"cross", make_camera(cube, 512, 384, {}, look_at(40 * deg, {}, {}), CubeLayout::cross)},
      {"equidistant", zenith_fisheye(fisheye_equidistant, 512)},
      {"equisolid", zenith_fisheye(fisheye_equisolid, 512)},
      {"stereographic", zenith_fisheye(fisheye_stereographic, 512)}};
  for (const auto& [name, camera] : skies) {
    const auto e = image_irradiance(camera, uniform_image(camera, 2));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(e[c] / (2 * kPi * (c + 1)), 1, 2e-4) << name;
  }
}

TEST(ImageFlux, OfAWholeSphereIsFourPi) {
  for (const auto& camera :
       {make_camera(Projection::lat_long, 77, 31, {}), make_camera(Projection::cube, 40, 240, {})})
    EXPECT_NEAR(image_flux(camera, uniform_image(camera, 1)).total.x, 4 * kPi, 1e-6);
}

TEST(ImageFlux, DoesNotDependOnTheNumberOfThreads) {
  const Camera camera = zenith_fisheye(Projection::fisheye_equidistant, 301);
  FrameBuffer image(301, 301);
  for (size_t i = 0; i < image.data().size(); ++i) image.data()[i] = float(i % 977) * 0.1F;
  const auto all = image_flux(camera, image);
  const ThreadLimit one(1);
  EXPECT_EQ(image_flux(camera, image).total, all.total);
}

}  // namespace
}  // namespace skylapse::image
