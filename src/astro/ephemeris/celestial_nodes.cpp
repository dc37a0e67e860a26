#include "astro/ephemeris/celestial_nodes.h"

#include <erfa.h>
#include <erfam.h>

#include <cmath>

namespace skylapse::astro {

EarthState earth_state(double tt_days) {
  double heliocentric[2][3];
  double barycentric[2][3];
  // Status +1 only says "outside 1900-2100", where the series lose accuracy slowly. TT stands in
  // for TDB: 2 ms at most, 0.06 km of the Earth's way.
  eraEpv00(ERFA_DJ00, tt_days, heliocentric, barycentric);
  EarthState s;
  s.heliocentric_position = {heliocentric[0][0], heliocentric[0][1], heliocentric[0][2]};
  s.heliocentric_velocity = {heliocentric[1][0], heliocentric[1][1], heliocentric[1][2]};
  s.barycentric_velocity = {barycentric[1][0], barycentric[1][1], barycentric[1][2]};
  eraXys06a(ERFA_DJ00, tt_days, &s.pole_x, &s.pole_y, &s.origin_locator_s);
  return s;
}

const EarthState& CelestialNodes::node(double hour) {
  const auto slot = static_cast<long>(hour) & (kNodes - 1);
  Node& n = nodes_[static_cast<size_t>(slot)];
  if (n.hour != hour) n = {.hour = hour, .state = earth_state(hour / 24)};
  return n.state;
}

EarthState CelestialNodes::at(double tt_days) {
  const double hours = tt_days * 24;
  const double begin = std::floor(hours);
  const EarthState& a = node(begin);
  const EarthState& b = node(begin + 1);
  const double u = hours - begin;
  const double v = 1 - u;
  const double step_days = 1.0 / 24;
  EarthState s;
  // Cubic Hermite; h00 = (1 + 2u) v^2, h10 = u v^2, h01 = u^2 (3 - 2u), h11 = -u^2 v.
  s.heliocentric_position = (1 + 2 * u) * v * v * a.heliocentric_position +
                            u * v * v * step_days * a.heliocentric_velocity +
                            u * u * (3 - 2 * u) * b.heliocentric_position -
                            u * u * v * step_days * b.heliocentric_velocity;
  s.heliocentric_velocity = v * a.heliocentric_velocity + u * b.heliocentric_velocity;
  s.barycentric_velocity = v * a.barycentric_velocity + u * b.barycentric_velocity;
  s.pole_x = v * a.pole_x + u * b.pole_x;
  s.pole_y = v * a.pole_y + u * b.pole_y;
  s.origin_locator_s = v * a.origin_locator_s + u * b.origin_locator_s;
  return s;
}

}  // namespace skylapse::astro
