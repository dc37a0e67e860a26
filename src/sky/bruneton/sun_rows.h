#pragma once
// Zenith angles of the sun: the nodes at which points are computed, and the rows of the tables,
// several to each interval, filled by limited cubic Hermite interpolation.
#include <algorithm>
#include <cmath>
#include <vector>

#include "sky/atmosphere/medium.h"
#include "sky/bruneton/settings.h"

namespace skylapse::sky::bruneton {

/// u = asinh((centre - theta) / width) runs evenly from the zenith to `end`.
struct SunWarp {
  double centre_rad, width_rad;
  double end_rad;
  bool dark_end;  // no light past `end`: its row is 0. False where it is at 180 deg.

  [[nodiscard]] double first() const { return std::asinh(centre_rad / width_rad); }
  [[nodiscard]] double span() const {
    return first() - std::asinh((centre_rad - end_rad) / width_rad);
  }
  /// theta at a share 0..1 of the rows.
  [[nodiscard]] double zenith_at(double share) const {
    return centre_rad - width_rad * std::sinh(first() - share * span());
  }
};

/// 7.55 mean heights of the higher of air and aerosol, but not more than the top: 60 km on Earth.
double scattering_top_km(const atmosphere::Medium& medium);

/// The warp of a medium. Light ends a little past 90 deg + 3 acos(R / (R + H)): a point at the top
/// then sees, along its horizon, no air that the sun still lights. Light falls fastest
/// about half of acos(R / (R + h)) below the horizon, h being scattering_top_km.
SunWarp sun_warp(const atmosphere::Medium& medium);

/// The nodes and rows of tables with given settings, which may be a part of all.
struct SunNodes {
  SunWarp warp;
  double first_share, share_step;  // of the warp: at node 0, and from node to node
  bool dark_end;                   // the last node is the warp's own and has no light

  [[nodiscard]] double zenith_rad(int node) const {
    return warp.zenith_at(first_share + node * share_step);
  }
};
SunNodes sun_nodes(const atmosphere::Medium& medium, const Settings& settings);

/// Slope at a node by its neighbouring secants: (2 geometric mean + harmonic mean) / 3, at most 3
/// times the smaller (no overshoot: Fritsch and Carlson 1980), 0 at an extremum. Light in twilight
/// and in thick air falls exponentially: for exp(-a x) this mean is the true slope up to a^5, where
/// the arithmetic mean is a^3 / 6 too steep (ground light 3 % too dark at sun 97).
inline double limited_slope(double before, double after) {
  if (before * after <= 0) return 0;
  const double harmonic = 2 * before * after / (before + after);
  const double geometric = std::copysign(std::sqrt(before * after), before);
  const double least = std::min(std::abs(before), std::abs(after));
  return std::copysign(std::min(std::abs(2 * geometric + harmonic) / 3, 3 * least), before);
}

/// Rows of one quantity (`stride` numbers apart, `channels` of them at each) from its nodes.
/// Slopes at the ends: the outermost secant at the first node; at the last too, or 0 if dark_end.
void upsample_suns(const double* nodes, size_t node_stride, double* rows, size_t row_stride,
                   int channels, const Settings& settings, bool dark_end);

}  // namespace skylapse::sky::bruneton
