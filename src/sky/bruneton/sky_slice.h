#pragma once
// All a frame needs to know of the sky: radiance over (azimuth from the sun, zenith angle) at the
// camera's height, already in XYZ. A pixel is two bilinear lookups.
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "core/quantity.h"
#include "sky/atmosphere/medium.h"

namespace skylapse::sky::bruneton {

/// Azimuth: node i of `azimuths` at phi = pi * (i / (azimuths - 1))^1.5 from the sun's azimuth, the
/// sky being symmetric. Zenith angle: `zeniths` (even) rows in two halves that never mix. Row
/// j < zeniths / 2 of the sky half has s = j / (zeniths / 2 - 1) and looks
/// e = sky_span * (b s^2 + (1 - b) s^4) above the geometric horizon, b = sky_bend; the rows of the
/// ground half follow, as far below it in their own span and bend. Nodes lie on the ends of both
/// axes.
struct SliceGrid {
  int azimuths = 64;
  int zeniths = 128;
  double horizon_zenith_rad = 0;  // zenith angle of the geometric horizon, pi/2 plus its dip
  double sky_span_rad = 0;        // to the zenith, or to the top of the atmosphere from outside it
  double ground_span_rad = 0;     // to the nadir: pi - horizon_zenith
  double sky_bend = 1;            // in (0, 1]; the less, the more rows lie close to the horizon
  double ground_bend = 1;

  /// Place s in [0, 1] of an elevation [rad] over (>= 0: in the sky half) or below the horizon.
  [[nodiscard]] double share(double over) const;
  /// The elevation's size [rad] at a place of the sky half or the ground half.
  [[nodiscard]] double elevation(double share, bool sky) const;

  friend bool operator==(const SliceGrid&, const SliceGrid&) = default;
};

/// Nodes [begin, end) of an axis.
struct NodeRange {
  int begin = 0, end = 0;
  [[nodiscard]] bool empty() const { return begin >= end; }
  friend bool operator==(const NodeRange&, const NodeRange&) = default;
};

/// A part of a slice: rows of the two halves, each counted from the horizon, by columns.
struct SliceWindow {
  NodeRange sky, ground, azimuths;
  [[nodiscard]] bool empty() const { return azimuths.empty() || (sky.empty() && ground.empty()); }
  [[nodiscard]] bool has_row(const SliceGrid& grid, int row) const {
    const int half = grid.zeniths / 2, place = row < half ? row : row - half;
    const NodeRange& range = row < half ? sky : ground;
    return place >= range.begin && place < range.end;
  }
  friend bool operator==(const SliceWindow&, const SliceWindow&) = default;
};
/// All of a grid.
SliceWindow whole_window(const SliceGrid& grid);

/// The grid of a camera at `height` (0 to far outside; asserted finite and >= 0).
SliceGrid slice_grid(const atmosphere::Medium& medium, Length height, int azimuths, int zeniths);
/// Sizes that keep the error of the bilinear lookup within the bound of docs/atmosphere.md: more
/// rows the higher the camera, since the limb grows thin.
SliceGrid slice_grid(const atmosphere::Medium& medium, Length height);

/// Radiance = smooth + aerosol * aerosol_phase(nu): W m^-2 sr^-1 with CIE weights, 1 au.
struct SkySlice {
  SliceGrid grid;
  double aerosol_g = 0;
  double sun_zenith_rad = 0;  // at the camera; the scattering sun
  /// [row][azimuth]. smooth: everything but the singly scattered aerosol light, and on the ground
  /// half also the ground itself, lit by sun and sky, seen through the air. w is not used.
  std::vector<glm::vec4> smooth, aerosol;
  /// The nodes that were computed; the others are 0 and stand for nothing. Nothing given: all.
  std::optional<SliceWindow> window{};

  /// Radiance at a zenith angle and azimuth from the sun: the double-precision lookup, which judges
  /// the pixel loop. Above sky_span (a camera in space) 0.
  [[nodiscard]] glm::dvec3 radiance_xyz(Angle zenith, Angle azimuth_from_sun) const;
};

/// A slice of a medium without any light; `window` says which of its nodes are to count.
SkySlice dark_slice(const atmosphere::Medium& medium, Angle sun_zenith, const SliceGrid& grid,
                    const std::optional<SliceWindow>& window = {});

}  // namespace skylapse::sky::bruneton
