#include "parity/twins.h"

#include "sky/atmosphere/atmosphere.h"

namespace skylapse::sky::bruneton {

atmosphere::Medium standard_medium(int bands) {
  const auto air = atmosphere::atmosphere_of({});
  EXPECT_TRUE(air.ok());
  return atmosphere::medium_at(*air, atmosphere::band_edges(bands));
}

Settings odd_settings() {
  Settings settings;
  settings.heights = 5;
  settings.suns = 33;
  settings.sun_rows_per_interval = 3;
  settings.directions_up = 5;
  settings.directions_down = 3;
  settings.azimuths = 7;
  settings.harmonics = 6;
  settings.table_azimuths = 7;
  settings.table_zeniths = 13;
  settings.samples = 3;
  settings.first_order_samples = 9;
  return settings;
}

std::shared_ptr<const Tables> reference_tables() {
  static const auto tables = [] {
    const atmosphere::Medium medium = atmosphere::reference_medium();
    return std::make_shared<const Tables>(
        precompute_twin(medium, settings_for(Level::draft, medium)));
  }();
  return tables;
}

}  // namespace skylapse::sky::bruneton
