#pragma once
// Sun and moon as an observer on the turning Earth sees them: light time, aberration, parallax.
#include "astro/ephemeris/celestial_nodes.h"
#include "astro/geodesy/enu_frame.h"
#include "astro/time/time_scales.h"

namespace skylapse::astro {

/// One moment's frames: built once, used for sun and moon.
struct SkyFrames {
  double tt_days = 0;
  EarthState earth;
  glm::dmat3 to_intermediate{1.0};  // GCRS -> celestial intermediate frame (true equator of date)
  glm::dmat3 to_earth_fixed{1.0};   // GCRS -> Earth-fixed (no polar motion: 0.6 arcsec at most)
  glm::dvec3 observer_au{};         // geocentric, GCRS
  glm::dvec3 observer_velocity{};   // barycentric, GCRS, au/day
};
SkyFrames sky_frames(const AstronomicalTime& time, const EarthState& earth,
                     const EnuFrame& observer);

/// A body's place. Vectors in au, GCRS axes, without aberration; unit vector with it.
struct ApparentPlace {
  glm::dvec3 topocentric_au{};         // light time included
  glm::dvec3 earth_fixed_direction{};  // unit; light time, annual and diurnal aberration
  double geocentric_distance_au = 0;
};

/// ERFA epv00. Error 0.015 arcsec (1900-2100).
ApparentPlace sun_place(const SkyFrames& frames);
/// ERFA moon98 (Meeus 1998, ch. 47). Error 2.9 arcsec RMS, 18.3 arcsec at worst; 6 km RMS,
/// 32 km at worst (the library's comparison with ELP/MPP02, 1950-2100).
ApparentPlace moon_place(const SkyFrames& frames);
/// Geocentric apparent declination of the sun on the true equator of date.
Angle sun_declination(const SkyFrames& frames);

}  // namespace skylapse::astro
