// No steps: in time, over the horizon, in height. 200 directions and all bands are in
// benchmarks/bruneton_twin.
#include <gtest/gtest.h>

#include <cmath>

#include "bruneton/twins.h"
#include "sky/bruneton/rays.h"

namespace skylapse::sky::bruneton {
namespace {

const Twin& standard_twin() {
  static const Twin twin = make_twin(green_medium(), Level::standard);
  return twin;
}

std::vector<double> twilight(Length height, Angle view_zenith, Angle azimuth, double from_deg,
                             double to_deg, double step_deg) {
  std::vector<double> radiance;
  for (double elevation = from_deg; elevation >= to_deg; elevation -= step_deg)
    radiance.push_back(
        standard_twin().answer({height, (90 - elevation) * deg, view_zenith, azimuth}).radiance[0]);
  return radiance;
}

const std::vector<std::pair<double, double>> kViews{{0, 0},    {60, 90},    {85, 0},
                                                    {80, 180}, {89.5, 180}, {89.9, 20}};

TEST(Twilight, NeverBrightensWhileTheSunSinks) {
  for (const auto& [zenith, azimuth] : kViews) {
    const std::vector<double> light =
        twilight(1 * metre, zenith * deg, azimuth * deg, -1, -18, 0.02);
    for (size_t i = 1; i < light.size(); ++i)
      EXPECT_LE(light[i], light[i - 1])
          << "view " << zenith << ' ' << azimuth << " sun " << -1 - 0.02 * double(i);
  }
}

/// Measure: second difference of the logarithm of radiance over steps of 0.02 degrees, 0.5 %.
/// Once the sky is 10^7 times darker than at noon it does not count.
TEST(Twilight, HasNoStepsInTime) {
  for (const auto& [zenith, azimuth] : kViews) {
    const std::vector<double> light =
        twilight(1 * metre, zenith * deg, azimuth * deg, 1, -12, 0.02);
    for (size_t i = 2; i < light.size(); ++i) {
      const double bend = std::log(light[i]) - 2 * std::log(light[i - 1]) + std::log(light[i - 2]);
      EXPECT_LT(std::abs(bend), 0.005)
          << "view " << zenith << ' ' << azimuth << " sun " << 1 - 0.02 * double(i);
    }
  }
}

TEST(Night, IsDarkPastTheReachOfScatteredLight) {
  for (const double sun : {125.0, 150.0, 180.0})
    for (const double view : {0.0, 60.0, 89.9})
      for (const double height : {0.0, 10.0, 60.0})
        EXPECT_EQ(standard_twin().answer({height * km, sun * deg, view * deg, 0 * deg}).radiance[0],
                  0);
}

/// In the last 1e-6 rad on either side radiance is smooth in the square root of the angle to the
/// horizon, as the distance to the ground and to the lowest point are.
TEST(Horizon, RadianceRunsSmoothlyUpToIt) {
  for (const double height : {1e-5, 1e-3, 0.1, 10.0, 50.0, 400.0})
    for (const double sun : {30.0, 88.0, 93.0})
      for (const double side : {-1e-6, 1e-6}) {
        const SliceGrid grid = slice_grid(green_medium(), height * km, 8, 8);
        const auto light = [&](double share) {
          const double zenith = grid.horizon_zenith_rad - side * share * share;
          return standard_twin()
              .answer({height * km, sun * deg, zenith * rad, 40 * deg})
              .radiance[0];
        };
        EXPECT_NEAR((light(0.1) + light(0.9)) / (2 * light(0.5)), 1, 4e-3)
            << height << ' ' << sun << ' ' << side;
      }
}

/// In-scatter over the same distance, the view crossing the horizon behind the target.
TEST(AerialPerspective, HasNoStripeAtTheHorizon) {
  const double R = standard_twin().medium().bottom_radius_km;
  const glm::dvec3 from(0, 0, R + 0.1), sun = glm::normalize(glm::dvec3(1, 0, 0.3));
  std::vector<double> light, seen;
  for (double zenith = 89.5; zenith < 90.2; zenith += 0.01) {
    const double z = zenith * text::PI / 180;
    const glm::dvec3 to = from + 20.0 * glm::dvec3(std::sin(z), 0, std::cos(z));
    const auto path = standard_twin().aerial_perspective(from, to, sun);
    light.push_back(path.in_scatter[0]);
    seen.push_back(path.transmittance[0]);
  }
  for (size_t i = 2; i < light.size(); ++i) {
    EXPECT_NEAR((light[i] + light[i - 2]) / (2 * light[i - 1]), 1, 1e-4) << i;
    EXPECT_NEAR((seen[i] + seen[i - 2]) / (2 * seen[i - 1]), 1, 1e-4) << i;
  }
}

TEST(Camera, RisesThroughTheTopWithoutAStep) {
  for (const double sun : {40.0, 92.0, 100.0})
    for (const double view : {95.0, 97.0, 120.0}) {
      const auto light = [&](double height_km) {
        return standard_twin()
            .answer({height_km * km, sun * deg, view * deg, 30 * deg})
            .radiance[0];
      };
      EXPECT_NEAR(light(60.001) / light(59.999), 1, 2e-3) << sun << ' ' << view;
      EXPECT_NEAR(light(60.0) / light(59.999), 1, 1e-3) << sun << ' ' << view;
    }
}

}  // namespace
}  // namespace skylapse::sky::bruneton
