#include "sky/monte_carlo/reference_image.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/parallel.h"
#include "sky/atmosphere/atmosphere.h"

namespace skylapse::sky::monte_carlo {
namespace {

const Direction<Enu> kSun = enu_direction(130 * deg, 35 * deg);

atmosphere::Medium default_air() {
  return medium_at(*atmosphere::atmosphere_of({}), atmosphere::band_edges(4));
}

image::Camera map(int width) {
  image::Camera camera;
  camera.projection = image::Projection::lat_long;
  camera.width = width, camera.height = width / 2;
  return camera;
}

struct Picture {
  image::FrameBuffer values, errors;
  ReferenceImageRecord record;
};
Picture render(const image::Camera& camera, const ReferenceOptions& options,
               Length height = 1 * metre, Angle horizon = {}) {
  const ReferenceScene scene(default_air(), height, kSun, options);
  Picture picture{{camera.width, camera.height}, {camera.width, camera.height}, {}};
  const auto record = render_reference(camera, {&scene, horizon}, picture.values, picture.errors);
  EXPECT_TRUE(record.ok());
  if (record) picture.record = *record;
  return picture;
}

TEST(ReferenceImage, IsTheSameOnAnyNumberOfThreads) {
  const ReferenceOptions options{.samples = 32, .seed = 5, .ground = true};
  Picture alone;
  {
    const ThreadLimit one(1);
    alone = render(map(16), options);
  }
  const Picture together = render(map(16), options);
  EXPECT_EQ(alone.values.data(), together.values.data());
  EXPECT_EQ(alone.errors.data(), together.errors.data());
  EXPECT_EQ(alone.record.paths, together.record.paths);
  EXPECT_EQ(alone.record.paths, 16 * 8 * 32);
}

TEST(ReferenceImage, PixelsHaveTheRadianceOfTheirCentre) {
  const atmosphere::Medium medium = default_air();
  const ReferenceScene scene(medium, 1 * metre, kSun, {.samples = 20000, .seed = 1});
  const Direction<Enu> view = enu_direction(60 * deg, 40 * deg);
  const ColourEstimate found = scene.radiance({{view, 1}}, 7);
  const ReferenceAnswer answer = reference_answer(medium, {1 * metre, 55 * deg, 50 * deg, 70 * deg},
                                                  {.samples = 20000, .seed = 2});
  double y = 0, error = 0;
  for (size_t b = 0; b < medium.bands.size(); ++b) {
    y += answer.radiance[b] * medium.bands[b].xyz_weight.y;
    error += answer.standard_error[b] * medium.bands[b].xyz_weight.y;
  }
  EXPECT_NEAR(found.xyz.y, y, 4 * std::hypot(error, std::sqrt(found.covariance[1][1])));
  EXPECT_LT(error, 0.02 * y);
}

TEST(ReferenceImage, ErrorsTellTheSpreadOfRepeats) {
  // 8 x 4 pixels, 6 repeats against a picture of 40 times the paths: the mean of z^2 over 576
  // values of some 200 independent ones is 1 +- 0.1.
  const image::Camera camera = map(8);
  const Picture truth = render(camera, {.samples = 12000, .seed = 99, .ground = true});
  double squares = 0;
  int count = 0;
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    const Picture picture = render(camera, {.samples = 300, .seed = seed, .ground = true});
    for (size_t i = 0; i < picture.values.data().size(); ++i) {
      if (picture.values.data()[i] == 0) continue;  // a colour that was cut off
      const double z = (picture.values.data()[i] - truth.values.data()[i]) /
                       std::hypot(picture.errors.data()[i], truth.errors.data()[i]);
      squares += z * z, ++count;
    }
  }
  EXPECT_GT(count, 500);
  EXPECT_GT(squares / count, 0.6);
  EXPECT_LT(squares / count, 1.5);
}

TEST(ReferenceImage, RunsUntilTheRelativeErrorIsReachedAndSaysWhereNot) {
  const Picture picture =
      render(map(8), {.samples = 20000, .relative_error = 0.05, .seed = 3, .ground = true});
  EXPECT_EQ(picture.record.share_reached, 1);
  EXPECT_LE(picture.record.max_relative_error, 0.05);
  EXPECT_LT(picture.record.paths, 32 * 20000);
  const Picture capped =
      render(map(8), {.samples = 64, .relative_error = 1e-4, .seed = 3, .ground = true});
  EXPECT_EQ(capped.record.share_reached, 0);
  EXPECT_GT(capped.record.mean_relative_error, 1e-3);
  EXPECT_LE(capped.record.mean_relative_error, capped.record.max_relative_error);
}

TEST(ReferenceImage, FromSpaceThereIsBlackSkyAndALitPlanet) {
  image::Camera camera = map(8);
  const double r = 6371, h = 2000;
  const Angle horizon = -std::acos(r / (r + h)) * rad;
  const Picture picture = render(camera, {.samples = 16, .ground = true}, h * km, horizon);
  for (int x = 0; x < 8; ++x) {
    EXPECT_EQ(picture.values.pixel(x, 0)[1], 0);
    EXPECT_EQ(picture.errors.pixel(x, 0)[1], 0);
  }
  EXPECT_GT(picture.values.pixel(4, 3)[1], 0);
}

TEST(ReferenceImage, StopsWhenItIsTold) {
  const ReferenceScene scene(default_air(), 1 * metre, kSun, {.samples = 16});
  const image::Camera camera = map(64);
  image::FrameBuffer values(64, 32), errors(64, 32);
  const auto record = render_reference(
      camera, {.scene = &scene, .progress = [](double) { return false; }}, values, errors);
  ASSERT_FALSE(record.ok());
  EXPECT_EQ(record.error().code, ErrorCode::interrupted);
}

TEST(ReferenceImage, OnePixelAndNoLightAreFine) {
  image::Camera camera = map(2);
  camera.height = 1, camera.width = 1;
  EXPECT_TRUE(std::isfinite(render(camera, {.samples = 16, .ground = true}).values.pixel(0, 0)[0]));
  const ReferenceScene night(default_air(), 1 * metre, enu_direction(0 * deg, -60 * deg),
                             {.samples = 16, .ground = true});
  image::FrameBuffer values(1, 1), errors(1, 1);
  const auto record = render_reference(camera, {&night}, values, errors);
  ASSERT_TRUE(record.ok());
  EXPECT_TRUE(std::isfinite(values.pixel(0, 0)[0]) && std::isfinite(record->max_relative_error));
}

}  // namespace
}  // namespace skylapse::sky::monte_carlo
