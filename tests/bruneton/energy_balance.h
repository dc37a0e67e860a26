#pragma once
// What light the tables and the marches account for; shared with benchmarks/bruneton_twin.
#include <cmath>

#include "bruneton/twins.h"
#include "sky/bruneton/physics.h"

namespace skylapse::sky::bruneton {

/// The tables' irradiance on the ground at a sun zenith angle.
inline double table_irradiance(const Tables& tables, Angle sun_zenith, int band) {
  PhysicsData data = physics_data(tables.medium, tables.settings, 2);
  data.tables = &tables;
  text::Physics<1> text(data, band / 4);
  return text.fetch_ground(0, text.sun_row_of(cos(sun_zenith)))[band % 4];
}

/// Flux that leaves the top upwards under a sun, per unit of sunlight.
inline double upward_flux(const Twin& twin, Angle sun_zenith) {
  MarchSettings march;
  march.ground = true;
  const Length top = twin.medium().top_height_km * km;
  // Ground and limb apart: their edge is a corner.
  const double horizon =
      text::PI / 2 +
      std::acos(1 / (1 + twin.medium().top_height_km / twin.medium().bottom_radius_km));
  double flux = 0;
  for (const auto& [from, to] : {std::pair{text::PI / 2, horizon}, {horizon, text::PI}})
    for (const glm::dvec2& z : gauss_nodes(12))
      for (const glm::dvec2& a : gauss_nodes(8)) {
        const double zenith = from + (to - from) * z.x;
        const double solid = (to - from) * z.y * std::sin(zenith) * 2 * text::PI * a.y;
        flux -=
            std::cos(zenith) * solid *
            twin.answer({top, sun_zenith, zenith * rad, text::PI * a.x * rad}, march).radiance[0];
      }
  return flux / twin.medium().bands[0].solar_irradiance;
}

/// Share of the light on the disc of radius R + H that passes through the air unscattered.
inline double light_that_passes(const Twin& twin) {
  const double R = twin.medium().bottom_radius_km, top = R + twin.medium().top_height_km;
  double passed = 0;
  for (const glm::dvec2& node : gauss_nodes(40)) {
    const double b = R + (top - R) * node.x;
    const Angle zenith = (text::PI - std::asin(b / top)) * rad;
    passed += (top - R) * node.y * 2 * b / (top * top) *
              twin.transmittance(twin.medium().top_height_km * km, zenith)[0];
  }
  return passed;
}

/// All that the sun sends must leave, over all the planet: the sum over sun zenith angles of the
/// flux at the top is the light on the planet's disc.
inline double returned_share(const atmosphere::Medium& medium, Level level) {
  const Twin twin = make_twin(medium, level);
  double flux = 0;
  const double dark = 125 * text::PI / 180;  // nothing leaves beyond
  for (const auto& [from, to] : {std::pair{0.0, text::PI / 2}, {text::PI / 2, dark}})
    for (const glm::dvec2& node : gauss_nodes(12)) {
      const double zenith = from + (to - from) * node.x;
      flux += (to - from) * node.y * 2 * std::sin(zenith) * upward_flux(twin, zenith * rad);
    }
  return flux + light_that_passes(twin);
}

}  // namespace skylapse::sky::bruneton
