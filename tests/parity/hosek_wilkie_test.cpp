// The formula on GL against the formula in double and against the tabulated images.
#include <gmock/gmock.h>

#include <cmath>

#include "parity/twins.h"
#include "sky/hosek_wilkie/sky_image_gpu.h"

namespace skylapse::sky::hosek_wilkie {
namespace {

using image::Camera;
using image::CubeLayout;
using image::FrameBuffer;
using image::Projection;

const glm::dvec3 kGround{0.3, 0.25, 0.2};

std::vector<Camera> cameras() {
  using enum Projection;
  const glm::dmat3 zenith = image::look_at(180 * deg, 90 * deg, {});
  const glm::dmat3 level = image::look_at(40 * deg, 5 * deg, 10 * deg);
  const auto strip = CubeLayout::vertical_strip;
  return {{lat_long, 64, 32, {}, strip, image::look_at(25 * deg, {}, {})},
          {perspective, 61, 47, 70 * deg, strip, level},
          {fisheye_equidistant, 50, 54, 180 * deg, strip, zenith},
          {fisheye_equisolid, 50, 50, 220 * deg, strip, zenith},
          {fisheye_stereographic, 50, 50, 190 * deg, strip, level},
          {cube, 16, 96, {}, strip, image::look_at({}, {}, {})},
          {cube, 64, 48, {}, CubeLayout::cross, image::look_at({}, {}, {})},
          {octahedral, 48, 48, {}, strip, image::look_at(25 * deg, {}, {})},
          {mirror_ball, 50, 50, {}, strip, level}};
}

Sky sky_of(Fit fit, double turbidity, double elevation) {
  AlbedoSpectrum albedo = grey_bands(0.3);
  return *Sky::make(fit, SolarFlux::reference, turbidity, albedo, elevation * deg);
}

glm::dvec3 expected_pixel(const Camera& camera, const ImageInputs& in, int x, int y) {
  const auto view = image::direction_at(camera, {x + 0.5, y + 0.5});
  if (!view) return glm::dvec3(0);
  const double share =
      image::horizon_coverage(elevation(*view), image::pixel_solid_angle(camera, x, y));
  const glm::dvec3 sky =
      glm::max(in.scale * (in.xyz_to_rgb * in.sky->radiance_xyz(*view, in.sun)), 0.0);
  return share * sky + (1 - share) * in.ground_rgb;
}

double scale_of(const Sky& sky) {
  glm::dvec3 scale(0);
  for (int n = 0; n < sky.patterns().count; ++n)
    scale += sky.patterns().items[n].scale * sky.xyz_weights()[n];
  return std::min({scale.x, scale.y, scale.z});
}

class AnyDome : public gpu::AnyContext {};

TEST_P(AnyDome, IsTheFormulaInEveryProjection) {
  for (const Fit fit : {Fit::spectral, Fit::xyz, Fit::rgb})
    for (const double elevation : {0.0, 3.0, 60.0, 90.0}) {
      const Sky sky = sky_of(fit, 3.3, elevation);
      const ImageInputs in{.sky = &sky,
                           .sun = enu_direction(70 * deg, elevation * deg),
                           .scale = 0.5,
                           .ground_rgb = kGround};
      const double floor = 1e-3 * scale_of(sky);
      for (const Camera& camera : cameras()) {
        FrameBuffer out(camera.width, camera.height);
        const Status status = render_sky_gpu(*context_, camera, in, out);
        ASSERT_TRUE(status.ok()) << status.error().message;
        for (int y = 0; y < camera.height; ++y)
          for (int x = 0; x < camera.width; ++x) {
            const glm::dvec3 expected = expected_pixel(camera, in, x, y);
            for (int c = 0; c < 3; ++c)
              ASSERT_NEAR(out.pixel(x, y)[c], expected[c], 1e-4 * std::max(expected[c], floor))
                  << int(camera.projection) << " at " << x << ", " << y << ", sun " << elevation;
          }
      }
    }
}

TEST_P(AnyDome, ImageOfSeveralPiecesHasNoSeams) {
  const Camera camera{Projection::lat_long,      1024, 512, {}, CubeLayout::vertical_strip,
                      image::look_at({}, {}, {})};
  ASSERT_GT(camera.width * camera.height, kPixelsAtOnce);
  const Sky sky = sky_of(Fit::spectral, 2.5, 20);
  const ImageInputs in{
      .sky = &sky, .sun = enu_direction(200 * deg, 20 * deg), .ground_rgb = kGround};
  FrameBuffer gl(camera.width, camera.height), cpu(camera.width, camera.height);
  const Status status = render_sky_gpu(*context_, camera, in, gl);
  ASSERT_TRUE(status.ok()) << status.error().message;
  render_sky(camera, in, cpu);
  for (size_t i = 0; i < cpu.data().size(); ++i)  // the tables' own error is 2e-3 at worst
    ASSERT_NEAR(gl.data()[i], cpu.data()[i],
                2.1e-3 * std::max<double>(cpu.data()[i], 1e-3 * scale_of(sky)));
}

SKYLAPSE_ON_EVERY_CONTEXT(AnyDome);

}  // namespace
}  // namespace skylapse::sky::hosek_wilkie
