#pragma once
// Unit vectors that know their frame. Directions point from the observer to the source.
#include <cassert>
#include <glm/glm.hpp>

#include "core/quantity.h"

namespace skylapse {

/// Local horizon frame: x east, y north, z up (normal of the WGS84 ellipsoid).
struct Enu {};
/// Geocentric Earth-fixed frame: x to (0 N, 0 E), z to the north pole.
struct EarthFixed {};
/// Geocentric celestial reference frame (ICRS axes).
struct Celestial {};
/// Camera frame: x right, y up, z forward (into the picture).
struct CameraFrame {};

template <class Frame>
class Direction {
 public:
  /// Default: the frame's z axis.
  constexpr Direction() = default;
  /// Normalises `v`; `v` must be finite and not null (asserted).
  static Direction from_vector(const glm::dvec3& v) {
    const double n = std::hypot(v.x, v.y, v.z);
    assert(n > 0 && std::isfinite(n));
    return Direction(v / n);
  }
  [[nodiscard]] const glm::dvec3& vec() const { return v_; }
  [[nodiscard]] double x() const { return v_.x; }
  [[nodiscard]] double y() const { return v_.y; }
  [[nodiscard]] double z() const { return v_.z; }

 private:
  explicit Direction(const glm::dvec3& v) : v_(v) {}
  glm::dvec3 v_{0, 0, 1};
};

/// Angle between two directions by atan2 of cross and dot product: exact to rounding for any
/// separation, 0 and 180 degrees included.
template <class Frame>
Angle separation(const Direction<Frame>& a, const Direction<Frame>& b) {
  const glm::dvec3 c = glm::cross(a.vec(), b.vec());
  return atan2_angle(std::hypot(c.x, c.y, c.z), glm::dot(a.vec(), b.vec()));
}

/// Azimuth from north, clockwise (east = 90 deg), in [0, 360 deg). At the zenith: 0.
Angle azimuth(const Direction<Enu>& d);
/// Elevation above the horizon plane, in [-90, 90] deg.
Angle elevation(const Direction<Enu>& d);
/// Direction of the given azimuth (any value) and elevation.
Direction<Enu> enu_direction(Angle azimuth, Angle elevation);

}  // namespace skylapse
