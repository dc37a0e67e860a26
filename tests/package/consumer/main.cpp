// What another project does with the library: where the sun stands, how bright the zenith is.
#include <skylapse/astro/ephemeris/ephemeris.h>
#include <skylapse/core/constants.h>
#include <skylapse/sky/hosek_wilkie/sky.h>

#include <cstdio>

int main() {
  using namespace skylapse;
  const auto noon = astro::parse_instant("2026-06-21T11:04:00Z");
  if (!noon) return 1;
  const astro::Ephemeris ephemeris;
  const auto state = ephemeris.sky_state(*noon, {50.0755 * deg, 14.4378 * deg, 235.0 * metre}, {});
  std::printf("sun elevation %.4f deg\n", elevation(state.sun_true).in(deg));

  using sky::hosek_wilkie::Sky;
  const auto model =
      Sky::make(sky::hosek_wilkie::Fit::spectral, sky::hosek_wilkie::SolarFlux::reference, 2.5,
                sky::grey_bands(0.2), elevation(state.sun_apparent));
  if (!model) return 1;
  const auto zenith = enu_direction(0.0 * deg, 90.0 * deg);
  const double y = model->radiance_xyz(zenith, state.sun_apparent).y;
  std::printf("zenith luminance %.0f cd/m^2\n", kLuminousEfficacy * y);
}
