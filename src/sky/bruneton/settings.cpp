#include "sky/bruneton/settings.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "sky/bruneton/harmonics.h"

namespace skylapse::sky::bruneton {

const std::vector<std::string>& level_names() {
  static const std::vector<std::string> kNames{"draft", "low", "standard", "fine"};
  return kNames;
}

std::string name_of(Level level) { return level_names()[size_t(level)]; }

Settings settings_for(Level level, const atmosphere::Medium& medium) {
  Settings s;
  switch (level) {
    case Level::draft:
      s.heights = 12, s.suns = 20, s.sun_rows_per_interval = 3;
      s.directions_up = 10, s.directions_down = 4, s.azimuths = 8, s.harmonics = 8;
      s.table_azimuths = 8, s.table_zeniths = 16;
      break;
    case Level::low:
      s.heights = 16, s.suns = 28;
      s.directions_up = 12, s.directions_down = 6, s.azimuths = 10, s.harmonics = 10;
      s.table_azimuths = 10, s.table_zeniths = 20;
      break;
    case Level::standard:
      break;
    case Level::fine:
      s.heights = 28, s.suns = 44;
      s.directions_up = 20, s.directions_down = 8, s.azimuths = 16, s.harmonics = 14;
      s.table_azimuths = 16, s.table_zeniths = 32;
      s.stop_below = 0.01;
      break;
  }
  (void)medium;
  return s;
}

std::string canonical_text(const Settings& s) {
  std::ostringstream out;
  out << std::hexfloat << s.heights << ' ' << s.suns << ' ' << s.sun_rows_per_interval << ' '
      << s.directions_up << ' ' << s.directions_down << ' ' << s.azimuths << ' ' << s.harmonics
      << ' ' << s.table_azimuths << ' ' << s.table_zeniths << ' ' << s.samples << ' '
      << s.first_order_samples << ' ' << s.max_orders << ' ' << s.stop_below;
  return out.str();
}

}  // namespace skylapse::sky::bruneton
