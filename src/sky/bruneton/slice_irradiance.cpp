#include "sky/bruneton/slice_irradiance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skylapse::sky::bruneton {

SliceGrid irradiance_grid(const atmosphere::Medium& medium, Length height) {
  // Half of a frame's rows: the more the higher, for the horizon's band of light is thin there.
  const int zeniths = slice_grid(medium, height).zeniths / 2;
  return slice_grid(medium, height, 24, zeniths + zeniths % 2);
}

SliceWindow irradiance_window(const SliceGrid& grid) {
  SliceWindow window = whole_window(grid);
  window.ground = {};
  return window;
}

glm::dvec3 horizontal_irradiance_xyz(const SkySlice& slice) {
  constexpr double kPi = std::numbers::pi, kNode = 0.5773502691896258;  // 1 / sqrt(3)
  // Steps of two Gauss nodes each, in s (over the horizon by span s^2) and in x (azimuth pi x^1.5):
  // they crowd at the horizon and towards the sun, where the light changes fastest.
  constexpr int kSteps = 48;
  const SliceGrid& grid = slice.grid;
  // Nothing below elevation 0 falls on a surface that faces up.
  const double lowest = grid.horizon_zenith_rad - 0.5 * kPi;
  if (lowest >= grid.sky_span_rad) return glm::dvec3(0);
  const double s0 = std::sqrt(std::max(0.0, lowest) / grid.sky_span_rad);
  glm::dvec3 sum(0);
  for (int i = 0; i < 2 * kSteps; ++i) {
    const double s = s0 + (1 - s0) * (i / 2 + 0.5 + (i % 2 == 0 ? -0.5 : 0.5) * kNode) / kSteps;
    const double zenith = grid.horizon_zenith_rad - grid.sky_span_rad * s * s;
    const double dzenith = 2 * grid.sky_span_rad * s * (1 - s0) / (2 * kSteps);
    for (int j = 0; j < 2 * kSteps; ++j) {
      const double x = (j / 2 + 0.5 + (j % 2 == 0 ? -0.5 : 0.5) * kNode) / kSteps;
      const double azimuth = kPi * std::pow(x, 1.5);
      const double dazimuth = 1.5 * kPi * std::sqrt(x) / (2 * kSteps);
      sum += 2 * dazimuth * dzenith * std::sin(zenith) * std::cos(zenith) *
             slice.radiance_xyz(zenith * rad, azimuth * rad);
    }
  }
  return sum;
}

}  // namespace skylapse::sky::bruneton
