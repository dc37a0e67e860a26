#include "astro/ephemeris/apparent_place.h"

#include <erfa.h>
#include <erfam.h>

#include <cmath>

namespace skylapse::astro {
namespace {

constexpr double kAuMetres = 149597870700.0;  // IAU 2012 Resolution B2
constexpr double kLightDaysPerAu = kAuMetres / 299792458.0 / 86400.0;
/// Turns of the Earth in a day of UT1 (Capitaine, Guinot & McCarthy 2000), as radians a day.
constexpr double kEarthSpinPerDay = 2 * std::numbers::pi * 1.00273781191135448;

glm::dmat3 from_rows(const double (&m)[3][3]) {
  return {m[0][0], m[1][0], m[2][0], m[0][1], m[1][1], m[2][1], m[0][2], m[1][2], m[2][2]};
}

/// Direction in which an observer moving at `velocity` (au/day) sees what stands at `place_au`.
glm::dvec3 aberrated(const glm::dvec3& place_au, const glm::dvec3& velocity, double sun_distance) {
  const glm::dvec3 natural = glm::normalize(place_au);
  const glm::dvec3 beta = velocity * kLightDaysPerAu;
  const double reciprocal_lorentz = std::sqrt(1 - glm::dot(beta, beta));
  const double n[3] = {natural.x, natural.y, natural.z};
  const double v[3] = {beta.x, beta.y, beta.z};
  double proper[3];
  eraAb(const_cast<double*>(n), const_cast<double*>(v), sun_distance, reciprocal_lorentz, proper);
  return {proper[0], proper[1], proper[2]};
}

/// The sun seen from the Earth's centre. While its light travels, the sun moves around the
/// barycentre by up to 8 km (0.011 arcsec).
glm::dvec3 geocentric_sun_au(const EarthState& earth) {
  const double light_days = glm::length(earth.heliocentric_position) * kLightDaysPerAu;
  const glm::dvec3 sun_velocity = earth.barycentric_velocity - earth.heliocentric_velocity;
  return -earth.heliocentric_position - light_days * sun_velocity;
}

}  // namespace

SkyFrames sky_frames(const AstronomicalTime& time, const EarthState& earth,
                     const EnuFrame& observer) {
  double intermediate[3][3];
  eraC2ixys(earth.pole_x, earth.pole_y, earth.origin_locator_s, intermediate);
  const double angle = eraEra00(ERFA_DJ00 + time.ut1_whole_days, time.ut1_day_fraction);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  SkyFrames f;
  f.tt_days = time.tt_days;
  f.earth = earth;
  f.to_intermediate = from_rows(intermediate);
  f.to_earth_fixed = glm::dmat3(c, -s, 0, s, c, 0, 0, 0, 1) * f.to_intermediate;
  const glm::dmat3 to_celestial = glm::transpose(f.to_earth_fixed);
  const glm::dvec3 origin_au = observer.origin_m / kAuMetres;
  f.observer_au = to_celestial * origin_au;
  f.observer_velocity =
      earth.barycentric_velocity +
      to_celestial * (kEarthSpinPerDay * glm::dvec3(-origin_au.y, origin_au.x, 0));
  return f;
}

ApparentPlace sun_place(const SkyFrames& frames) {
  const glm::dvec3 geocentric = geocentric_sun_au(frames.earth);
  ApparentPlace p;
  p.geocentric_distance_au = glm::length(geocentric);
  p.topocentric_au = geocentric - frames.observer_au;
  p.earth_fixed_direction =
      frames.to_earth_fixed *
      aberrated(p.topocentric_au, frames.observer_velocity, p.geocentric_distance_au);
  return p;
}

ApparentPlace moon_place(const SkyFrames& frames) {
  double moon[2][3];
  eraMoon98(ERFA_DJ00, frames.tt_days, moon);
  const glm::dvec3 position(moon[0][0], moon[0][1], moon[0][2]);
  const glm::dvec3 velocity(moon[1][0], moon[1][1], moon[1][2]);
  const double light_days = glm::length(position - frames.observer_au) * kLightDaysPerAu;
  // Both the moon about the Earth and the Earth itself moved on since the light left.
  const glm::dvec3 when_light_left =
      position - light_days * (velocity + frames.earth.barycentric_velocity);
  ApparentPlace p;
  p.geocentric_distance_au = glm::length(position - light_days * velocity);
  p.topocentric_au = when_light_left - frames.observer_au;
  p.earth_fixed_direction =
      frames.to_earth_fixed * aberrated(p.topocentric_au, frames.observer_velocity,
                                        glm::length(frames.earth.heliocentric_position));
  return p;
}

Angle sun_declination(const SkyFrames& frames) {
  const glm::dvec3 geocentric = geocentric_sun_au(frames.earth);
  const glm::dvec3 d =
      frames.to_intermediate *
      aberrated(geocentric, frames.earth.barycentric_velocity, glm::length(geocentric));
  return atan2_angle(d.z, std::hypot(d.x, d.y));
}

}  // namespace skylapse::astro
