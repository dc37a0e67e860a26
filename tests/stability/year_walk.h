#pragma once
// A walk through time, minute by minute, that measures the greatest step of everything a sequence
// of frames is made from: sun, exposure, light.
#include <array>
#include <string>

#include "astro/ephemeris/ephemeris.h"
#include "astro/time/instant.h"

namespace skylapse::stability {

struct Place {
  const char* name;
  astro::GeodeticPosition position;
};
/// Both poles, the equator, a middle latitude, the polar circle, the antimeridian.
const std::array<Place, 6>& places();

/// A greatest step and where it was.
struct Step {
  double size = 0;
  std::string where;
};

/// Greatest steps from one minute to the next.
struct Steps {
  long minutes = 0;
  long broken = 0;     // values that are not finite, or out of their range
  Step true_sun;       // deg, direction of the airless sun
  Step apparent_sun;   // deg, of the refracted one
  Step sky_model_sun;  // deg, of the sun that the fitted sky is asked for
  Step refraction;     // deg, of the angle of refraction
  Step exposure;       // stops, of the planned sun curve
  Step luminance;      // stops, of the mean luminance of the computed sky
  Step twilight;       // stops, of the fitted sky's light after sunset
  void add(const Steps& other);
};

/// `minutes` steps from `begin`; whatever the place, none may exceed `bounds()`.
Steps walk(const Place& place, const astro::Instant& begin, long minutes);

/// What a minute can do. The sun turns 360.9856 deg a day on the equator of the sky, 0.2507 deg a
/// minute; refraction that fades out below the horizon adds a third of that at most (its slope is
/// 0.32 in the densest air, tests/astro/refraction_test.cpp); the twilight of the published
/// illuminance loses 2.1 stops a degree at the most, and 0.86 of that is exposed.
Steps bounds();

/// Lines of a table: each quantity's greatest step, its bound and its place.
std::string table(const Steps& steps);
/// True if nothing is broken and no step exceeds its bound.
bool within_bounds(const Steps& steps);

}  // namespace skylapse::stability
