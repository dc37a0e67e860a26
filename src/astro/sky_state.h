#pragma once
// What stands where in the sky: the one value that the sky models and the planner see.
#include "core/frames.h"
#include "core/quantity.h"

namespace skylapse::astro {

/// WGS84 geodetic: latitude north positive in [-90, 90] deg, longitude east positive (any turn),
/// height above the ellipsoid.
struct GeodeticPosition {
  Angle latitude;
  Angle longitude;
  Length height;
};

/// Air at the observer, for refraction. Defaults: those of the formula (Saemundsson 1986).
struct RefractionConditions {
  bool enabled = true;
  Pressure pressure = 1010.0 * hPa;
  TemperatureCelsius temperature = 10.0 * degC;
};

struct SkyState {
  Direction<Enu> sun_true;      // topocentric, airless
  Direction<Enu> sun_apparent;  // refracted; equals sun_true when refraction is off
  Length sun_distance;          // geocentric
  Angle sun_radius;             // angular radius of the disc
  Angle sun_declination;        // geocentric apparent, true equator of date
  Direction<Enu> moon_true;     // topocentric
  Direction<Enu> moon_apparent;
  Length moon_distance;  // topocentric
  Angle moon_radius;     // angular
  double moon_illuminated_fraction = 0;
  Angle moon_phase_angle;  // 0 = full, 180 deg = new
};

}  // namespace skylapse::astro
