#include "image/lighting/irradiance_map.h"

#include <gtest/gtest.h>

#include <numbers>

#include "image/irradiance.h"
#include "skies.h"

namespace skylapse::image {
namespace {

constexpr double kPi = std::numbers::pi;

Camera lat_long_map(int width) {
  Camera camera;
  camera.projection = Projection::lat_long;
  camera.width = width, camera.height = width / 2;
  return camera;
}

glm::dvec3 pixel_of(const Camera& camera, const FrameBuffer& map, const glm::dvec3& d) {
  const auto p = position_of(camera, Direction<Enu>::from_vector(d));
  const float* rgb =
      map.pixel(std::min(int(p->x), camera.width - 1), std::min(int(p->y), camera.height - 1));
  return {rgb[0], rgb[1], rgb[2]};
}

TEST(IrradianceMap, ConstantSkyGivesPiTimesItsRadianceEverywhere) {
  const Camera sky = strip_heading(10 * deg, 96);
  const auto picture = cube_of(sky, [](const glm::dvec3&) { return glm::dvec3{1, 0.3, 5e4}; });
  for (const Camera& camera : {lat_long_map(32), strip_heading(50 * deg, 8)}) {
    const auto map = irradiance_map(camera, sky, picture, {});
    for (size_t i = 0; i < map.data().size(); ++i)
      ASSERT_FLOAT_EQ(map.data()[i], float(kPi * picture.data()[i % 3]));
  }
}

// L = 1 + d z: E = pi + 2 pi / 3 n z in closed form.
TEST(IrradianceMap, LinearSkyHasItsClosedForm) {
  const Camera sky = strip_heading({}, 128), camera = lat_long_map(32);
  const auto picture = cube_of(sky, [](const glm::dvec3& d) { return glm::dvec3{1 + d.z}; });
  const auto map = irradiance_map(camera, sky, picture, {});
  for (int y = 0; y < camera.height; ++y) {
    const double z = direction_at(camera, {0.5, y + 0.5})->z();
    EXPECT_NEAR(map.pixel(7, y)[0], kPi + 2 * kPi / 3 * z, 5e-4) << y;
  }
}

TEST(IrradianceMap, PoleIsTheGroundsIrradianceByTheSky) {
  const Camera sky = strip_heading(30 * deg, 256), camera = lat_long_map(64);
  const auto picture = cube_of(sky, clear_sky);
  const auto map = irradiance_map(camera, sky, picture, {});
  const glm::dvec3 expected = image_irradiance(sky, picture);
  // The first row is 2.8 deg / 2 from the pole on average over the azimuths: to second order.
  glm::dvec3 mean{0};
  for (int x = 0; x < camera.width; ++x)
    for (int c = 0; c < 3; ++c) mean[c] += map.pixel(x, 0)[c] / double(camera.width);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c] / expected[c], 1, 1e-3) << c;
}

TEST(IrradianceMap, IsTheSameForSourcesOfSixteenTimesAsManyPieces) {
  const Camera sky = strip_heading(30 * deg, 256);
  const auto picture = cube_of(sky, clear_sky);
  const Camera camera = lat_long_map(16);
  const auto map = irradiance_map(camera, sky, picture, {});
  double brightest = 0;
  for (int i = 0; i < 12; ++i) {
    const glm::dvec3 n = direction_at(camera, {1.3 * i + 0.2, 0.65 * i + 0.4})->vec();
    const auto centre = position_of(camera, Direction<Enu>::from_vector(n));
    const glm::dvec3 at =
        direction_at(camera, {std::floor(centre->x) + 0.5, std::floor(centre->y) + 0.5})->vec();
    glm::dvec3 sum{0};
    for (int y = 0; y < sky.height; ++y)
      for (int x = 0; x < sky.width; ++x) {
        const float* p = picture.pixel(x, y);
        const double c = glm::dot(at, direction_at(sky, {x + 0.5, y + 0.5})->vec());
        if (c > 0) sum += c * pixel_solid_angle(sky, x, y).in(sr)*glm::dvec3(p[0], p[1], p[2]);
      }
    brightest = std::max(brightest, sum.x);
    EXPECT_NEAR(pixel_of(camera, map, n).x, sum.x, 5e-4 * brightest + 2e-4) << i;
  }
}

TEST(IrradianceMap, LightsAddTheirCosineAndNothingFromBehind) {
  const Camera sky = strip_heading({}, 16), camera = strip_heading({}, 32);
  const FrameBuffer black(16, 96);
  const auto sun = enu_direction(200 * deg, 30 * deg);
  const std::vector<PointLight> lights{{sun, {10, 20, 30}}, {sun, {1, 1, 1}}};
  const auto map = irradiance_map(camera, sky, black, lights);
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const double c = glm::dot(direction_at(camera, {x + 0.5, y + 0.5})->vec(), sun.vec());
      ASSERT_NEAR(map.pixel(x, y)[1], 21 * std::max(0.0, c), 1e-5);
    }
}

}  // namespace
}  // namespace skylapse::image
