#include "image/lighting/harmonics.h"

#include <gtest/gtest.h>

#include <numbers>

#include "skies.h"

namespace skylapse::image {
namespace {

constexpr double kPi = std::numbers::pi;
const glm::dmat3 kEnu{1.0};

Harmonics of_sky(const Radiance& radiance, int side = 32, const glm::dmat3& axes = kEnu) {
  const Camera camera = strip_heading(20 * deg, side);
  return project_picture(camera, cube_of(camera, radiance), axes);
}

TEST(Harmonics, AreOrthonormalOverTheSphere) {
  for (int i = 0; i < kHarmonics; ++i) {
    const auto h = of_sky([i](const glm::dvec3& d) { return glm::dvec3{harmonics_at(d)[i]}; }, 96);
    // Midpoints of pixels of 1/48: their square over 24, times l(l + 1) of the product.
    for (int j = 0; j < kHarmonics; ++j) EXPECT_NEAR(h[j].x, i == j, 2e-4) << i << ' ' << j;
  }
}

TEST(Harmonics, ConstantSkyIsItsFirstTermAlone) {
  const auto h = of_sky([](const glm::dvec3&) { return glm::dvec3{2, 3, 4}; });
  EXPECT_NEAR(h[0].y, 3 * std::sqrt(4 * kPi), 1e-6);
  for (int i = 1; i < kHarmonics; ++i) EXPECT_NEAR(h[i].y, 0, 1e-4) << i;
  for (const glm::dvec3 n : {glm::dvec3{0, 0, 1}, {1, 0, 0}, {0.6, 0, -0.8}})
    EXPECT_NEAR(irradiance_of(h, n).y, 3 * kPi, 1e-3);
}

// L = max(0, d z) and L = 1 + d z are cosines of the zenith angle: known coefficients.
TEST(Harmonics, CosineSkyHasTheCoefficientsOfTheCosine) {
  const auto h = of_sky([](const glm::dvec3& d) { return glm::dvec3{std::max(0.0, d.z)}; }, 128);
  EXPECT_NEAR(h[0].x, kPi * std::sqrt(1 / (4 * kPi)), 1e-4);
  EXPECT_NEAR(h[2].x, 2 * kPi / 3 * std::sqrt(3 / (4 * kPi)), 1e-4);
  EXPECT_NEAR(h[6].x, kPi / 4 * std::sqrt(5 / (4 * kPi)), 1e-4);
  for (const int i : {1, 3, 4, 5, 7, 8}) EXPECT_NEAR(h[i].x, 0, 1e-6) << i;
  const auto linear = of_sky([](const glm::dvec3& d) { return glm::dvec3{1 + d.z}; }, 96);
  // Degrees 0 and 1 are exact: E = pi + 2 pi / 3 n z.
  for (const double z : {-1.0, -0.3, 0.0, 1.0})
    EXPECT_NEAR(irradiance_of(linear, {std::sqrt(1 - z * z), 0, z}).x, kPi + 2 * kPi / 3 * z, 1e-3);
}

TEST(Harmonics, SingleDirectionMissesTheClampedCosineByThreeThirtySecondsAtMost) {
  const auto d = enu_direction(70 * deg, 35 * deg);
  const PointLight sun{d, {2, 1, 0.5}};
  const auto h = project_lights({&sun, 1}, kEnu);
  double worst = 0;
  for (int i = 0; i <= 1000; ++i) {
    const Angle t = 180.0 * i / 1000 * deg;
    const auto n = enu_direction(70 * deg, 35 * deg + t);
    const double c = cos(t);
    const double theory = 0.25 + c / 2 + 5.0 / 32 * (3 * c * c - 1);
    EXPECT_NEAR(irradiance_of(h, n.vec()).x, 2 * theory, 1e-12);
    worst = std::max(worst, std::abs(theory - std::max(0.0, c)));
  }
  EXPECT_NEAR(worst, 3.0 / 32, 1e-9);
}

TEST(Harmonics, TurningTheAxesTurnsTheLight) {
  const glm::dmat3 turn = look_at(33 * deg, 21 * deg, 70 * deg);  // a mirror: worse than turning
  const auto a = of_sky(clear_sky, 64), b = of_sky(clear_sky, 64, turn);
  for (const int first : {0, 1, 4}) {  // the power of each degree is the same
    const int last = first == 0 ? 1 : first == 1 ? 4 : 9;
    glm::dvec3 pa{0}, pb{0};
    for (int i = first; i < last; ++i) pa += a[i] * a[i], pb += b[i] * b[i];
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(pb[c] / pa[c], 1, 1e-12) << first;
  }
  for (const glm::dvec3 v : {glm::dvec3{0, 0, 1}, {1, 2, 2}, {-3, 1, -1}}) {
    const glm::dvec3 n = glm::normalize(v);
    EXPECT_LT(glm::length(irradiance_of(b, turn * n) - irradiance_of(a, n)), 1e-10);
  }
}

TEST(Harmonics, AddUpAndConvolve) {
  const PointLight sun{enu_direction(10 * deg, 5 * deg), {1, 2, 3}};
  const auto sky = of_sky(clear_sky), disc = project_lights({&sun, 1}, kEnu),
             all = sum_of(sky, disc);
  const auto y = harmonics_at({0, 0, 1});
  const auto e = cosine_convolved(all);
  glm::dvec3 sum{0};
  for (int i = 0; i < kHarmonics; ++i) sum += y[i] * e[i];
  EXPECT_LT(glm::length(sum - irradiance_of(sky, {0, 0, 1}) - irradiance_of(disc, {0, 0, 1})),
            1e-12);
}

}  // namespace
}  // namespace skylapse::image
