// The nodes of sky::mean_computed_sky_luminance: illuminance by the sky alone on the ground, of the
// air of a config that says nothing, at sun elevations from the zenith to the end of twilight.
//   clear_sky_nodes [level]
#include <fmt/format.h>

#include <algorithm>

#include "core/constants.h"
#include "sky/atmosphere/atmosphere.h"
#include "sky/bruneton/twin.h"

int main(int argc, char** argv) {
  using namespace skylapse;
  using namespace skylapse::sky;
  const auto& names = bruneton::level_names();
  const auto name = std::find(names.begin(), names.end(), argc > 1 ? argv[1] : "standard");
  if (name == names.end()) return 3;
  const auto air = atmosphere::atmosphere_of({});
  if (!air) return 7;
  const auto medium = atmosphere::medium_at(*air, atmosphere::band_edges(16));
  const auto settings = settings_for(bruneton::Level(name - names.begin()), medium);
  const bruneton::Twin twin(
      std::make_shared<const bruneton::Tables>(precompute_twin(medium, settings)));
  for (const double elevation :
       {-18., -16., -14., -13., -12., -11., -10., -9., -8., -7., -6., -5., -4., -3., -2.,
        -1.,  0.,   1.,   2.,   3.,   5.,   7.,   10., 15., 20., 30., 45., 60., 75., 90.}) {
    const auto sky = twin.irradiance(Length{}, (90 - elevation) * deg).sky;
    double y = 0;
    for (size_t b = 0; b < sky.size(); ++b) y += sky[b] * medium.bands[b].xyz_weight.y;
    fmt::print("{{{:g}, {:.4g}}},\n", elevation, kLuminousEfficacy * y);
  }
}
