#pragma once
// The observer's local frame within the Earth-fixed one.
#include "astro/sky_state.h"

namespace skylapse::astro {

/// Place and axes of an observer, in the Earth-fixed frame (WGS84; x to 0 N 0 E, z to the north
/// pole). Up is the normal of the ellipsoid. At the poles north is the limit along the meridian of
/// the given longitude: at +90 deg (-cos lon, -sin lon, 0), at -90 deg (cos lon, sin lon, 0).
struct EnuFrame {
  glm::dvec3 origin_m{};
  glm::dvec3 east{};
  glm::dvec3 north{};
  glm::dvec3 up{};

  /// Components of an Earth-fixed vector along east, north, up.
  [[nodiscard]] glm::dvec3 to_enu(const glm::dvec3& earth_fixed) const {
    return {glm::dot(east, earth_fixed), glm::dot(north, earth_fixed), glm::dot(up, earth_fixed)};
  }
};

/// Through GeographicLib::Geocentric (WGS84), so it equals LocalCartesian's frame.
/// Domain: latitude in [-90, 90] deg (asserted), any longitude; +180 and -180 deg give equal axes.
EnuFrame enu_frame(const GeodeticPosition& position);

}  // namespace skylapse::astro
