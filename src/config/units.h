#pragma once
// The units that a config may use, by what is measured. One table for reading, messages, the
// schema and the docs.
#include <span>
#include <string>
#include <string_view>

namespace skylapse::config {

enum class Dimension {
  none,
  angle,
  latitude,   // an angle; a plain number is in degrees, N and S may replace the sign
  longitude,  // the same with E and W
  length,
  duration,
  days,  // whole calendar days
  pressure,
  temperature,
  exposure_value,  // EV at ISO 100, or stops; a plain number will do
  exposure_rate,   // stops per minute; a plain number will do
  frame_rate,      // frames per second; a plain number will do
  ozone,           // Dobson units
  wavelength,
  share,  // of a whole
};

struct UnitName {
  std::string_view symbol;
  double factor;       // base value = value * factor + offset
  double offset = 0;   // temperatures
  bool listed = true;  // named in messages; the others are further spellings
};

/// What is known about a dimension. Base units are those of core/quantity.h (rad, m, s, hPa,
/// degree Celsius, nm); days, EV, EV per minute, frames per second and Dobson units for the rest.
struct DimensionInfo {
  std::string_view name;            // "an angle"
  std::span<const UnitName> units;  // the usual one first
  std::string_view bare_unit{};     // unit of a plain number; empty: a unit is required
  bool compound = false;            // "2 h 30 min", "50 deg 4 min": sums with falling units
};

const DimensionInfo& info_of(Dimension dimension);

/// "deg, rad, arcmin, arcsec"
std::string unit_list(Dimension dimension);

/// The dimension that a unit belongs to, for messages; `none` if it is unknown.
Dimension dimension_of_unit(std::string_view symbol);

}  // namespace skylapse::config
