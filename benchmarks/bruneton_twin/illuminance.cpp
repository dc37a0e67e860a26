// Horizontal illuminance at sea level against the USNO table (src/sky/twilight.h).
#include <fmt/format.h>

#include <cmath>

#include "core/constants.h"
#include "sky/atmosphere/atmosphere.h"
#include "sky/twilight.h"
#include "studies.h"

namespace skylapse::sky::bruneton {
namespace {

double lux_of(const atmosphere::Medium& medium, const std::vector<double>& irradiance) {
  double y = 0;
  for (size_t b = 0; b < medium.bands.size(); ++b)
    y += irradiance[b] * medium.bands[b].xyz_weight.y;
  return kLuminousEfficacy * y;
}

atmosphere::Medium clear_medium(Length top, int bands) {
  atmosphere::AirDescription air;
  air.top_height = top;
  const auto atmosphere = atmosphere::atmosphere_of(air);
  return atmosphere::medium_at(atmosphere.value(), atmosphere::band_edges(bands));
}

}  // namespace

void study_illuminance(Level level) {
  struct Column {
    Length top;
    int heights;  // 0: by rule
  };
  const std::vector<Column> columns{{60 * km, 0}, {80 * km, 0}, {100 * km, 0}, {100 * km, 40}};
  std::vector<Twin> twins;
  for (const Column& column : columns) {
    const atmosphere::Medium medium = clear_medium(column.top, 8);
    Settings settings = settings_for(level, medium);
    if (column.heights > 0) settings.heights = column.heights;
    twins.push_back(twin_of(medium, settings));
  }
  fmt::print(
      "sun elevation   published lx   ratio: top 60 km   80 km   100 km   100 km, 40 heights\n");
  for (const double elevation : {60.0, 30.0, 10.0, 5.0,  2.0,  0.0,   -0.8,  -2.0,  -3.0,  -4.0,
                                 -5.0, -6.0, -7.0, -8.0, -9.0, -10.0, -11.0, -12.0, -13.0, -14.0}) {
    const double published = clear_sky_illuminance(elevation * deg).in(lux);
    fmt::print("{:8.1f} {:16.5g}", elevation, published);
    for (const Twin& twin : twins) {
      const Twin::Irradiance light = twin.irradiance(0 * km, (90 - elevation) * deg);
      fmt::print("{:10.3f}",
                 (lux_of(twin.medium(), light.sun) + lux_of(twin.medium(), light.sky)) / published);
    }
    fmt::print("\n");
  }
}

}  // namespace skylapse::sky::bruneton
