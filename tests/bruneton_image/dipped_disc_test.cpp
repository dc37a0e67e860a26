// The sun's disc over the horizon of a camera above the ground, which lies below elevation 0.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sky/sun_disc.h"

namespace skylapse::sky {
namespace {

constexpr double kPi = std::numbers::pi;
const Angle kRadius = 0.2666 * deg;
const std::vector<double> kHorizons{-0.01, -1.7, -3.4, -19.8, -81.3, -89.1};

/// Smooth over the disc, steep in elevation: air that reddens by half within the disc.
SunDisc disc_at(double azimuth, double elevation, double horizon) {
  SunDisc disc;
  disc.centre = enu_direction(azimuth * deg, elevation * deg);
  disc.radius = kRadius;
  disc.horizon = horizon * deg;
  disc.radiance = [=](Angle el, double m) {
    const double over = el.in(deg)-horizon;
    return (0.4 + 0.6 * m) * glm::dvec3(1 + over, 2 + 3 * over * over, std::exp(over));
  };
  return disc;
}

/// Irradiance by a fine polar grid about the disc's centre, cut sharply at the horizon.
DiscEnergy brute_energy(const SunDisc& disc) {
  const glm::dvec3 c = disc.centre.vec();
  const glm::dvec3 side = glm::normalize(glm::cross(c, glm::dvec3(0.3, 0.8, 0.1)));
  const glm::dvec3 up = glm::cross(side, c);
  constexpr int kRings = 400, kSteps = 500;
  const double r = disc.radius.in(rad);
  DiscEnergy energy;
  for (int i = 0; i < kRings; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double gamma = (i + 0.5) / kRings * r, turn = (j + 0.5) / kSteps * 2 * kPi;
      const glm::dvec3 d =
          c * std::cos(gamma) + (side * std::cos(turn) + up * std::sin(turn)) * std::sin(gamma);
      const double el = std::atan2(d.z, std::hypot(d.x, d.y));
      if (el < disc.horizon.in(rad)) continue;
      const double q = std::sin(gamma) / std::sin(r);
      const double domega = std::sin(gamma) * r / kRings * 2 * kPi / kSteps;
      const glm::dvec3 light = domega * disc.radiance(el * rad, std::sqrt(1 - q * q));
      energy.normal_irradiance += light;
      energy.horizontal_irradiance += std::max(0.0, d.z) * light;
    }
  return energy;
}

// The grid's sharp cut is right to about one cell in 400.
TEST(DippedDisc, EnergyIsThatOfThePartOverTheHorizon) {
  for (const double horizon : kHorizons)
    for (const double over : {-0.26, -0.1, 0.0, 0.13, 0.2665, 0.3, 2.0}) {
      const SunDisc disc = disc_at(77, horizon + over, horizon);
      const DiscEnergy energy = disc_energy(disc), expected = brute_energy(disc);
      const DiscEnergy whole = disc_energy(disc_at(77, horizon + 0.3, horizon));
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(energy.normal_irradiance[c], expected.normal_irradiance[c],
                    2e-3 * whole.normal_irradiance[c])
            << horizon << " " << over;
    }
}

// Strips of equal elevation (dip) and vertical strips (none) are two ways to one integral.
TEST(DippedDisc, TendsToTheLevelHorizonAsTheDipVanishes) {
  for (const double over : {-0.2, 0.0, 0.1, 0.25}) {
    const DiscEnergy level = disc_energy(disc_at(20, over, 0));
    const DiscEnergy dipped = disc_energy(disc_at(20, over - 1e-9, -1e-9));
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(dipped.normal_irradiance[c] / level.normal_irradiance[c], 1, 2e-6) << over;
      EXPECT_NEAR(dipped.horizontal_irradiance[c] / level.horizontal_irradiance[c], 1, 2e-6);
    }
  }
}

TEST(DippedDisc, SetsWithoutAStep) {
  for (const double horizon : kHorizons) {
    const double whole = disc_energy(disc_at(5, horizon + 0.4, horizon)).normal_irradiance.y;
    double previous = 0;
    for (double over = -0.28; over < 0.4; over += 0.002) {
      const double now = disc_energy(disc_at(5, horizon + over, horizon)).normal_irradiance.y;
      // A disc two of its radii high: no step uncovers more than this.
      EXPECT_LT(std::abs(now - previous), 0.01 * whole + 1e-12) << horizon << " " << over;
      previous = now;
    }
  }
}

TEST(DippedDisc, NothingIsLeftBelowTheHorizon) {
  for (const double horizon : kHorizons) {
    const SunDisc disc = disc_at(5, std::max(-89.9, horizon - 0.27), horizon);
    EXPECT_EQ(disc_energy(disc).normal_irradiance, glm::dvec3(0)) << horizon;
  }
}

/// The disc in pictures of every size.
TEST(DippedDisc, PicturesHoldTheEnergyOfThePartOverTheHorizon) {
  for (const double horizon : {-1.7, -19.8, -81.3})
    for (const double over : {-0.2, 0.0, 0.2, 1.0})
      for (const int width : {33, 400}) {
        const SunDisc disc = disc_at(77, horizon + over, horizon);
        const image::Camera camera{image::Projection::perspective,
                                   width,
                                   width,
                                   3 * deg,
                                   {},
                                   image::look_at(77 * deg, (horizon + over) * deg, 10 * deg)};
        const DiscEnergy expected = disc_energy(disc);
        const ProjectedDisc projected = project_sun_disc(camera, disc);
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(projected.energy.normal_irradiance[c] / expected.normal_irradiance[c], 1,
                      1e-9)
              << horizon << " " << over << " " << width;
        const double side =
            std::sqrt(image::pixel_solid_angle(camera, width / 2, width / 2).in(sr));
        for (const PixelAddition& pixel : projected.pixels) {
          const auto d = image::direction_at(camera, {pixel.x + 0.5, pixel.y + 0.5});
          EXPECT_GT(elevation(*d).in(rad), disc.horizon.in(rad)-0.51 * side);
        }
      }
}

}  // namespace
}  // namespace skylapse::sky
