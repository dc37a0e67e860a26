#include "pipeline/coarse_picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "image/irradiance.h"

namespace skylapse::pipeline {
namespace {

using image::Projection;

image::Camera camera_of(Projection projection, int width, int height) {
  image::Camera camera;
  camera.projection = projection;
  camera.width = width, camera.height = height;
  return camera;
}

/// A sky with a bright spot and a bright horizon, each a few degrees wide, and dark ground.
Status fill(const image::Camera& camera, image::FrameBuffer& out) {
  const glm::dvec3 spot = glm::normalize(glm::dvec3(1, 2, 0.3));
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const auto d = image::direction_at(camera, {x + 0.5, y + 0.5});
      if (!d || d->z() < 0) continue;
      const double gamma =
          std::acos(std::min(1.0, glm::dot(spot, glm::dvec3(d->x(), d->y(), d->z()))));
      const double value = 1 + 50 * std::exp(-gamma / 0.05) + 10 * std::exp(-d->z() / 0.03);
      for (int c = 0; c < 3; ++c) out.pixel(x, y)[c] = float(value * (1 + c));
    }
  return Done{};
}

TEST(CoarsePicture, MapsGetFinerSamplesUntilTheyHave512Around) {
  EXPECT_EQ(finer_samples(camera_of(Projection::lat_long, 64, 32)), 8);
  EXPECT_EQ(finer_samples(camera_of(Projection::lat_long, 511, 256)), 2);
  EXPECT_EQ(finer_samples(camera_of(Projection::lat_long, 512, 256)), 1);
  EXPECT_EQ(finer_samples(camera_of(Projection::cube, 64, 384)), 2);
  EXPECT_EQ(finer_samples(camera_of(Projection::cube, 128, 768)), 1);
  EXPECT_EQ(finer_samples(camera_of(Projection::octahedral, 256, 256)), 2);
  EXPECT_EQ(finer_samples(camera_of(Projection::lat_long, 1, 1)), 512);
  EXPECT_EQ(finer_samples(camera_of(Projection::perspective, 64, 32)), 1);
}

TEST(CoarsePicture, KeepsTheFluxOfTheFinePictureAndNeverAddsToTheGroundsIrradiance) {
  for (const image::Camera& camera :
       {camera_of(Projection::lat_long, 64, 32), camera_of(Projection::lat_long, 7, 5),
        camera_of(Projection::cube, 16, 96), camera_of(Projection::octahedral, 64, 64),
        camera_of(Projection::lat_long, 1, 1)}) {
    const int n = finer_samples(camera);
    image::Camera fine = camera;
    fine.width *= n, fine.height *= n;
    image::FrameBuffer samples(fine.width, fine.height);
    ASSERT_TRUE(fill(fine, samples));
    const auto out = averaged_picture(camera, n, fill);
    ASSERT_TRUE(out.ok());
    const auto before = image::image_flux(fine, samples), after = image::image_flux(camera, *out);
    for (int c = 0; c < 3; ++c) {
      // Solid angles of pixels are good to 1e-6 where a projection is smooth over them; at the
      // corners of an octahedron, and over whole spheres, they are not.
      EXPECT_NEAR(after.total[c] / before.total[c], 1, 1e-3) << camera.width;
      EXPECT_LE(after.horizontal_irradiance[c], before.horizontal_irradiance[c] * (1 + 1e-6));
    }
  }
}

TEST(CoarsePicture, AnErrorOfTheFillIsPassedOn) {
  const auto out = averaged_picture(camera_of(Projection::lat_long, 64, 32), 2,
                                    [](const image::Camera&, image::FrameBuffer&) -> Status {
                                      return Error{ErrorCode::interrupted, "stop"};
                                    });
  ASSERT_FALSE(out.ok());
  EXPECT_EQ(out.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace skylapse::pipeline
