#include "astro/ephemeris/celestial_nodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "../measured.h"

namespace skylapse::astro::test {
namespace {

constexpr double kArcsec = 206264.80624709636;

TEST(CelestialNodes, InterpolationStaysFarBelowTheModelsOwnError) {
  CelestialNodes nodes;
  Largest sun, pole, aberration;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> day(-36500, 36500);
  for (int i = 0; i < 3000; ++i) {
    const double t = day(random);
    const EarthState exact = earth_state(t);
    const EarthState quick = nodes.at(t);
    const std::string where = std::to_string(t);
    sun.see(kArcsec * glm::length(exact.heliocentric_position - quick.heliocentric_position),
            where);
    pole.see(kArcsec * std::hypot(exact.pole_x - quick.pole_x, exact.pole_y - quick.pole_y), where);
    aberration.see(
        kArcsec * glm::length(exact.barycentric_velocity - quick.barycentric_velocity) / 173.1446,
        where);
  }
  // Linear: h^2 / 8 times the second derivative; 0.23" of 13.66 d in the pole, and in the Earth's
  // velocity its yearly turn plus 12 m/s around the barycentre with the moon.
  expect_within(sun, 1e-6, "sun by interpolation, arcsec");
  expect_within(pole, 2e-5, "pole by interpolation, arcsec");
  expect_within(aberration, 2e-6, "aberration by interpolation, arcsec");
}

TEST(CelestialNodes, ResultsDoNotDependOnEarlierCalls) {
  std::vector<double> times;
  for (int i = 0; i < 500; ++i) times.push_back(9000 + i * 0.37);  // 185 days: slots are reused
  CelestialNodes in_order;
  std::vector<double> expected;
  for (const double t : times) expected.push_back(in_order.at(t).pole_x);
  std::vector<size_t> order(times.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937_64(7));
  CelestialNodes shuffled;
  for (const size_t i : order) EXPECT_EQ(shuffled.at(times[i]).pole_x, expected[i]);
}

TEST(CelestialNodes, JoinsItsHoursWithoutAStep) {
  CelestialNodes nodes;
  for (int hour = -5; hour < 100; ++hour) {
    const double t = hour / 24.0;
    const EarthState before = nodes.at(std::nextafter(t, -1e9));
    const EarthState after = nodes.at(std::nextafter(t, 1e9));
    EXPECT_LT(glm::length(before.heliocentric_position - after.heliocentric_position), 1e-13);
    EXPECT_LT(std::abs(before.pole_x - after.pole_x), 1e-16);
  }
}

}  // namespace
}  // namespace skylapse::astro::test
