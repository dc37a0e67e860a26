// Laws that hold for every atmosphere.
#include <gtest/gtest.h>

#include <cmath>

#include "bruneton/twins.h"

namespace skylapse::sky::bruneton {
namespace {

const atmosphere::Medium& reference() {
  static const atmosphere::Medium medium = atmosphere::reference_medium();
  return medium;
}

/// A point above the surface, some way round the planet.
glm::dvec3 place(double height_km, double turn_rad) {
  return (reference().bottom_radius_km + height_km) *
         glm::dvec3(std::sin(turn_rad), 0, std::cos(turn_rad));
}

const glm::dvec3 kSun = glm::normalize(glm::dvec3(0.8, 0.2, 0.4));

struct Path {
  glm::dvec3 from, to;
};
std::vector<Path> paths() {
  return {{place(0.001, 0), place(8, 0.01)},
          {place(2, 0), place(3, 0.02)},
          {place(400, 0), place(0.5, 0.1)},
          {place(10, 0), place(400, 0.35)},
          {place(100, -0.15), place(100, 0.15)}};
}

/// Both sides are marched, with 16 samples a piece each: 0.1 % is their error (SingleScattering).
TEST(AerialPerspective, JoinedTransmittancesMultiplyAndInScatterAdds) {
  const Twin twin = make_twin(reference());
  for (const Path& path : paths())
    for (const double share : {0.1, 0.5, 0.8}) {
      const glm::dvec3 middle = path.from + share * (path.to - path.from);
      const auto whole = twin.aerial_perspective(path.from, path.to, kSun);
      const auto first = twin.aerial_perspective(path.from, middle, kSun);
      const auto second = twin.aerial_perspective(middle, path.to, kSun);
      for (int b = 0; b < 3; ++b) {
        EXPECT_NEAR(first.transmittance[b] * second.transmittance[b] / whole.transmittance[b], 1,
                    1e-3);
        EXPECT_NEAR((first.in_scatter[b] + first.transmittance[b] * second.in_scatter[b]) /
                        whole.in_scatter[b],
                    1, 2e-3)
            << share;
      }
    }
}

TEST(AerialPerspective, TransmittanceIsTheSameBothWays) {
  const Twin twin = single_scattering_twin(reference());
  for (const Path& path : paths()) {
    const auto there = twin.aerial_perspective(path.from, path.to, kSun);
    const auto back = twin.aerial_perspective(path.to, path.from, kSun);
    for (int b = 0; b < 3; ++b)
      EXPECT_NEAR(there.transmittance[b] / back.transmittance[b], 1, 1e-3);
  }
}

TEST(AerialPerspective, OfNoDistanceIsNothing) {
  const Twin twin = single_scattering_twin(reference());
  const auto none = twin.aerial_perspective(place(1, 0), place(1, 0), kSun);
  EXPECT_EQ(none.in_scatter, std::vector<double>(3, 0.0));
  EXPECT_EQ(none.transmittance, std::vector<double>(3, 1.0));
}

TEST(AerialPerspective, ToTheSkyIsTheAnswerOfThatDirection) {
  const Twin twin = make_twin(reference());
  const glm::dvec3 up(0, 0, 1), east(1, 0, 0);
  const glm::dvec3 from = place(0.5, 0), sun = glm::normalize(0.5 * up + 1.0 * east);
  const double sun_zenith = std::acos(sun.z);
  for (const double zenith : {0.3, 1.2, 1.56}) {
    const glm::dvec3 view = std::cos(zenith) * up + std::sin(zenith) * east;
    const auto path = twin.aerial_perspective(from, from + 3000.0 * view, sun);
    const Answer answer = twin.answer({0.5 * km, sun_zenith * rad, zenith * rad, 0 * rad});
    for (int b = 0; b < 3; ++b)
      EXPECT_NEAR(path.in_scatter[b] / answer.radiance[b], 1, 1e-9) << zenith;
  }
}

/// Over a planet that is nearly flat, light reflected from sun s to view v obeys
/// L(s, v) / cos s = L(v, s) / cos v. What the 0.5 % allows: curvature (0.1 %), tables of the draft
/// level.
TEST(MultipleScattering, IsReciprocalOverAWidePlanet) {
  atmosphere::Medium medium = green_medium();
  medium.bottom_radius_km = 60000;
  medium.bands[0].ground_albedo = 0.5;
  const Twin twin = make_twin(medium, Level::low);
  MarchSettings march;
  march.ground = true;
  const Length top = medium.top_height_km * km;
  const auto reflected = [&](Angle sun, Angle view, Angle azimuth) {
    return twin.answer({top, sun, 180 * deg - view, azimuth}, march).radiance[0] / cos(sun);
  };
  for (const Angle azimuth : {0 * deg, 60 * deg, 180 * deg})
    for (const auto& [sun, view] :
         {std::pair{20 * deg, 60 * deg}, {0 * deg, 45 * deg}, {35 * deg, 70 * deg}})
      EXPECT_NEAR(reflected(sun, view, azimuth) / reflected(view, sun, azimuth), 1, 0.005)
          << sun.in(deg) << ' ' << view.in(deg) << ' ' << azimuth.in(deg);
}

}  // namespace
}  // namespace skylapse::sky::bruneton
