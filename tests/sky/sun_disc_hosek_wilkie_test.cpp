// The sun disc with the radiance it is made for.
#include <gtest/gtest.h>

#include "sky/hosek_wilkie/solar_disc.h"
#include "sky/sun_disc.h"
#include "sun_disc_cameras.h"

namespace skylapse::sky {
namespace {

using hosek_wilkie::SolarDisc;

SunDisc hosek_wilkie_sun(const SolarDisc& model, Angle azimuth, Angle elevation) {
  return {enu_direction(azimuth, elevation), model.radius(),
          [&model](Angle view, double limb) { return model.radiance_xyz(view, limb); }};
}

TEST(SunDiscOfHosekWilkie, HasTheIrradianceOfTheModelsOwnQuadrature) {
  // In thicker air the setting sun is gone (below 1e-4 of its light at noon) and the model's
  // polynomials are clipped at zero within the disc.
  for (const double turbidity : {1.0, 2.5, 5.0}) {
    const auto model =
        SolarDisc::make(turbidity, hosek_wilkie::SolarFlux::reference, kTestRadius).value();
    for (const double el : {0.0, 0.1, 0.26, 0.5, 2.0, 15.0, 60.0, 90.0}) {
      const DiscEnergy energy = disc_energy(hosek_wilkie_sun(model, 50 * deg, el * deg));
      const auto own = model.irradiance(el * deg);
      // The bounds that the model states for its quadrature.
      const double bound = el < 0.3 ? 1e-3 : 1e-4;
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(energy.normal_irradiance[c] / own.normal_xyz[c], 1, bound)
            << turbidity << ' ' << el;
        EXPECT_NEAR(energy.horizontal_irradiance[c] / own.horizontal_xyz[c], 1, bound)
            << turbidity << ' ' << el;
      }
    }
  }
}

TEST(SunDiscOfHosekWilkie, MayBeDarkInThickAir) {
  const auto model = SolarDisc::make(10, hosek_wilkie::SolarFlux::reference, kTestRadius).value();
  const SunDisc sun = hosek_wilkie_sun(model, 200.3 * deg, 0 * deg);
  for (const auto& [name, camera, fisheye] : cameras_around(256, 200.3 * deg, 0 * deg))
    for (const auto& [x, y, radiance] : project_sun_disc(camera, sun).pixels)
      EXPECT_EQ(radiance, glm::dvec3{0}) << name;
}

TEST(SunDiscOfHosekWilkie, KeepsItsEnergyInEveryProjection) {
  const auto model = SolarDisc::make(3, hosek_wilkie::SolarFlux::reference, kTestRadius).value();
  for (const int width : {64, 1000})
    for (const double el : {0.0, 0.1, 0.27, 2.0, 30.0, 89.9}) {
      const SunDisc sun = hosek_wilkie_sun(model, 200.3 * deg, el * deg);
      const DiscEnergy reference = disc_energy(sun);
      for (const auto& [name, camera, fisheye] : cameras_around(width, 200.3 * deg, el * deg)) {
        const auto energy = project_sun_disc(camera, sun).energy;
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(energy.normal_irradiance[c] / reference.normal_irradiance[c], 1, 1e-6)
              << name << ' ' << el;
      }
    }
}

}  // namespace
}  // namespace skylapse::sky
