#include "core/frames.h"

namespace skylapse {

Angle azimuth(const Direction<Enu>& d) {
  if (d.x() == 0 && d.y() == 0) return {};
  const double a = std::atan2(d.x(), d.y());
  constexpr double kTurn = 2 * std::numbers::pi;
  const double positive = a < 0 ? a + kTurn : a;
  return (positive >= kTurn ? 0.0 : positive) * rad;  // -1e-17 + 2 pi rounds to 2 pi
}

Angle elevation(const Direction<Enu>& d) { return atan2_angle(d.z(), std::hypot(d.x(), d.y())); }

Direction<Enu> enu_direction(Angle azimuth, Angle elevation) {
  const double c = cos(elevation);
  return Direction<Enu>::from_vector({c * sin(azimuth), c * cos(azimuth), sin(elevation)});
}

}  // namespace skylapse
