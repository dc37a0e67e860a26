#include "image/lighting/specular.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "image/lighting/sources.h"
#include "skies.h"

namespace skylapse::image {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(GgxKernel, IntegratesToOneOverTheSphere) {
  for (const double alpha : {0.01, 0.0278, 0.2, 0.7, 0.9999, 1.0}) {
    double sum = 0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) {  // in steps that shrink towards the peak: c = 1 - u^3
      const double u = (i + 0.5) / n;
      sum += 2 * kPi * GgxKernel(alpha).at_cosine(1 - u * u * u) * 3 * u * u / n;
    }
    EXPECT_NEAR(sum, 1, 1e-5) << alpha;
    EXPECT_EQ(GgxKernel(alpha).at_cosine(-0.1), 0);
  }
}

// The sum of samples as Karis 2013 writes it (PrefilterEnvMap), many of them.
TEST(GgxKernel, IsWhatSamplesOfTheSplitSumTendTo) {
  const double roughness = 0.5, alpha = alpha_of_roughness(roughness);
  const glm::dvec3 towards = glm::normalize(glm::dvec3{0.4, 0, 1});
  const auto sky = [&](double c) { return std::exp(3 * c); };
  double light = 0, weight = 0;
  const int n = 1 << 18;
  for (int i = 0; i < n; ++i) {
    uint32_t bits = uint32_t(i);
    bits = (bits << 16) | (bits >> 16);
    bits = ((bits & 0x55555555U) << 1) | ((bits & 0xAAAAAAAAU) >> 1);
    bits = ((bits & 0x33333333U) << 2) | ((bits & 0xCCCCCCCCU) >> 2);
    bits = ((bits & 0x0F0F0F0FU) << 4) | ((bits & 0xF0F0F0F0U) >> 4);
    bits = ((bits & 0x00FF00FFU) << 8) | ((bits & 0xFF00FF00U) >> 8);
    const double x = (i + 0.5) / n, y = bits * 2.3283064365386963e-10;
    const double phi = 2 * kPi * x;
    const double cos_h = std::sqrt((1 - y) / (1 + (alpha * alpha - 1) * y));
    const double sin_h = std::sqrt(1 - cos_h * cos_h);
    const glm::dvec3 h{sin_h * std::cos(phi), sin_h * std::sin(phi), cos_h};
    const glm::dvec3 l = 2 * cos_h * h - glm::dvec3{0, 0, 1};
    if (l.z <= 0) continue;
    light += l.z * sky(glm::dot(l, towards));
    weight += l.z;
  }
  double expected = 0;
  const int m = 400;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) {
      const double c = (i + 0.5) / m, phi = 2 * kPi * (j + 0.5) / m, s = std::sqrt(1 - c * c);
      expected += GgxKernel(alpha).at_cosine(c) * 2 * kPi / m / m *
                  sky(glm::dot({s * std::cos(phi), s * std::sin(phi), c}, towards));
    }
  EXPECT_NEAR(light / weight / expected, 1, 1e-3);
}

TEST(Roughness, GoesEvenlyFromMirrorToOne) {
  EXPECT_EQ(roughness_of_level(0, 7), 0);
  EXPECT_EQ(roughness_of_level(6, 7), 1);
  EXPECT_DOUBLE_EQ(roughness_of_level(3, 7), 0.5);
  EXPECT_EQ(roughness_of_level(0, 1), 0);
  EXPECT_DOUBLE_EQ(alpha_of_roughness(0.5), 0.25);
}

TEST(Specular, ConstantSkyStaysConstant) {
  const Camera camera = strip_heading(15 * deg, 48);
  const auto sky = cube_of(camera, [](const glm::dvec3&) { return glm::dvec3{0.7, 5e4, 3}; });
  const SpecularSource source(camera, sky, 0.02);
  for (const double alpha : {0.02, 0.3, 1.0})
    for (const int side : {33, 4}) {
      const auto level = source.filtered(side, alpha);
      for (size_t i = 0; i < level.data().size(); ++i)
        ASSERT_FLOAT_EQ(level.data()[i], sky.data()[i % 3]) << alpha;
    }
}

TEST(Specular, EveryLevelHasTheSkysFluxAndOnlyALittleOfItIsSet) {
  const Camera camera = strip_heading(15 * deg, 128);
  const auto sky = cube_of(camera, clear_sky);
  const SpecularSource source(camera, sky, 0.0278);
  const glm::dvec3 flux = flux_of(sky);
  for (const auto& [side, alpha] : {std::pair{64, 0.0278}, {32, 0.111}, {16, 0.25}, {4, 1.0}}) {
    const glm::dvec3 got = flux_of(source.filtered(side, alpha));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c] / flux[c], 1, 1e-6) << alpha;
  }
}

/// By all pixels of the sky.
glm::dvec3 brute_force(const Camera& camera, const FrameBuffer& sky, double alpha,
                       const glm::dvec3& n) {
  glm::dvec3 sum{0};
  double weights = 0;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const double c = glm::dot(n, direction_at(camera, {x + 0.5, y + 0.5})->vec());
      const double w = pixel_solid_angle(camera, x, y).in(sr)*GgxKernel(alpha).at_cosine(c);
      const float* p = sky.pixel(x, y);
      sum += w * glm::dvec3(p[0], p[1], p[2]);
      weights += w;
    }
  return sum / weights;
}

// In the faces' middles, on their edges and in their corners: a texel is the light about its own
// direction, wherever the edges are, so cubes have no seams.
TEST(Specular, AgreesWithTheSumOverAllPixels) {
  const Camera camera = strip_heading(15 * deg, 128);
  const auto sky = cube_of(camera, clear_sky);
  const SpecularSource source(camera, sky, 0.0278);
  for (const auto& [side, alpha] : {std::pair{64, 0.0278}, {64, 0.111}, {32, 0.25}, {32, 1.0}}) {
    double worst = 0;
    const auto level = source.filtered(side, alpha);
    const Camera view = strip_camera(camera, side);
    for (int i = 0; i < 8; ++i) {
      const int x = i < 4 ? (i * 37 + 5) % side : (i % 2) * (side - 1);
      const int y = i < 6 ? (i * 101 + 11) % (6 * side) : (i - 6) * 5 * side;
      const glm::dvec3 expected =
          brute_force(camera, sky, alpha, direction_at(view, {x + 0.5, y + 0.5})->vec());
      const float* p = level.pixel(x, y);
      for (int c = 0; c < 3; ++c) {
        worst = std::max(worst, std::abs(p[c] / expected[c] - 1));
        EXPECT_NEAR(p[c] / expected[c], 1, 5e-3) << alpha << ' ' << x << ' ' << y;
      }
    }
    RecordProperty("worst at alpha " + std::to_string(alpha), std::to_string(worst));
  }
}

std::vector<PointLight> small_disc(const Direction<Enu>& centre, double irradiance) {
  std::vector<PointLight> lights;
  for (int i = 0; i < 40; ++i) {
    const double r = std::sqrt((i + 0.5) / 40) * 0.00465, t = 2.39996 * i;
    const glm::dvec3 shift{r * std::cos(t), r * std::sin(t), 0};
    lights.push_back({Direction<Enu>::from_vector(centre.vec() + shift),
                      glm::dvec3{1, 0.9, 0.8} * irradiance / 40.0});
  }
  return lights;
}

TEST(SpecularLights, KeepTheirIrradianceAtEveryRoughnessAndSide) {
  const Camera camera = strip_heading(15 * deg, 8);
  for (const double el : {35.264, 0.0, 90.0})  // a corner, the horizon, a pole
    for (const auto& [side, alpha] :
         {std::pair{256, 0.005}, {128, 0.0278}, {64, 0.111}, {4, 1.0}, {1, 0.01}}) {
      FrameBuffer strip(side, 6 * side);
      add_filtered_lights(camera, small_disc(enu_direction(60 * deg, el * deg), 146), alpha, strip);
      EXPECT_NEAR(flux_of(strip).x / 146, 1, 1e-6) << side << ' ' << alpha;
      EXPECT_NEAR(flux_of(strip).z / 146 / 0.8, 1, 1e-6) << side << ' ' << alpha;
    }
}

TEST(SpecularLights, HaveTheKernelsShape) {
  const Camera camera = strip_heading({}, 64);
  const auto sun = enu_direction(20 * deg, 30 * deg);
  FrameBuffer strip(64, 384);
  add_filtered_lights(camera, small_disc(sun, 1), 0.111, strip);
  for (int y = 0; y < 384; y += 7)
    for (int x = 0; x < 64; x += 5) {
      const double c = glm::dot(sun.vec(), direction_at(camera, {x + 0.5, y + 0.5})->vec());
      if (c < 0.05) continue;
      EXPECT_NEAR(strip.pixel(x, y)[0] / GgxKernel(0.111).at_cosine(c), 1, 0.02) << c;
    }
}

TEST(SpecularLights, FitUnderAPeak) {
  const auto lights = small_disc(enu_direction({}, 50 * deg), 146);
  const double alpha = alpha_for_peak(lights, 65000);
  EXPECT_NEAR(146 * GgxKernel(alpha).at_cosine(1), 65000, 1);
  FrameBuffer strip(256, 6 * 256);
  add_filtered_lights(strip_heading({}, 256), lights, alpha, strip);
  EXPECT_LE(*std::max_element(strip.data().begin(), strip.data().end()), 65504.0F);
}

}  // namespace
}  // namespace skylapse::image
