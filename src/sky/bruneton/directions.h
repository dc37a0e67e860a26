#pragma once
// The incident directions at which a point gathers its light.
#include <vector>

#include "sky/bruneton/physics.h"
#include "sky/bruneton/settings.h"

namespace skylapse::sky::bruneton {

/// Cosines of zenith angle with weights that sum to 2: first the directions above the horizon, from
/// it to the zenith, then those below, from it to the nadir. mu = mu_h + (1 - mu_h) s^1.5 above and
/// mu_h - (1 + mu_h) s^1.5 below, s Gauss-Legendre: deep twilight lives at the horizon.
struct DirectionRows {
  std::vector<double> mu, weight;
  int up = 0;  // rows above the horizon
};
DirectionRows direction_rows(Geometry geometry, const Settings& settings, double height_km);

/// Azimuths from the sun's: midpoints of `azimuths` equal parts of half the circle.
inline double direction_azimuth(int i, int azimuths) { return text::PI * (i + 0.5) / azimuths; }

/// Height of a point of the tables: node i of settings.heights, clustered at the ground.
double height_node(const atmosphere::Medium& medium, const Settings& settings, int i);
/// Exponent of that clustering: h = H (i / (N - 1))^kHeightExponent but for layers (layers.h).
inline constexpr double kHeightExponent = 2.5;

}  // namespace skylapse::sky::bruneton
