#pragma once
// The slow part of an ephemeris, evaluated once an hour and interpolated in between.
#include <array>
#include <glm/glm.hpp>
#include <limits>

namespace skylapse::astro {

/// Where the Earth is and how its axis points, in the GCRS; lengths in au, velocities in au/day.
struct EarthState {
  glm::dvec3 heliocentric_position{};
  glm::dvec3 heliocentric_velocity{};
  glm::dvec3 barycentric_velocity{};
  double pole_x = 0, pole_y = 0;  // celestial intermediate pole (IAU 2006/2000A)
  double origin_locator_s = 0;    // CIO locator
};

/// ERFA's epv00 and xys06a (together 50 us) at whole hours of TT.
///
/// Between two hours: cubic Hermite for the position, linear for the rest. The nodes stand on a
/// fixed grid and each depends on its hour alone, so a result never depends on earlier calls.
/// Error    against direct evaluation below 2e-5 arcsec in the pole, 2e-6 in aberration, 1e-6 in
///          the sun's place (tested).
/// Memory   a direct-mapped table of the last 64 hours: two days of event search stay in it.
class CelestialNodes {
 public:
  /// `tt_days` from J2000.0.
  [[nodiscard]] EarthState at(double tt_days);

 private:
  static constexpr int kNodes = 64;
  struct Node {
    double hour = std::numeric_limits<double>::quiet_NaN();  // equals no hour: empty
    EarthState state;
  };
  const EarthState& node(double hour);
  std::array<Node, kNodes> nodes_;
};

/// The same without interpolation.
EarthState earth_state(double tt_days);

}  // namespace skylapse::astro
