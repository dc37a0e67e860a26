#include "sky/bruneton/sky_slice.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "sky/bruneton/physics.h"

namespace skylapse::sky::bruneton {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

}  // namespace

double SliceGrid::share(double over) const {
  const double span = over < 0 ? ground_span_rad : sky_span_rad;
  const double b = over < 0 ? ground_bend : sky_bend;
  const double q = span > 0 ? std::min(std::abs(over) / span, 1.0) : 0;
  return std::min(1.0, std::sqrt(2 * q / (b + std::sqrt(b * b + 4 * (1 - b) * q))));
}

double SliceGrid::elevation(double share, bool sky) const {
  const double b = sky ? sky_bend : ground_bend, q = share * share;
  return (sky ? sky_span_rad : ground_span_rad) * q * (b + (1 - b) * q);
}

SliceWindow whole_window(const SliceGrid& grid) {
  const int half = grid.zeniths / 2;
  return {{0, half}, {0, half}, {0, grid.azimuths}};
}

SliceGrid slice_grid(const atmosphere::Medium& medium, Length height, int azimuths, int zeniths) {
  const double h = height.in(km), R = medium.bottom_radius_km, H = medium.top_height_km;
  assert(std::isfinite(h) && h >= 0 && azimuths >= 2 && zeniths >= 4 && zeniths % 2 == 0);
  SliceGrid grid;
  grid.azimuths = azimuths;
  grid.zeniths = zeniths;
  const double dip = std::atan2(std::sqrt(h * (2 * R + h)), R);
  grid.horizon_zenith_rad = kHalfTurn / 2 + dip;
  grid.ground_span_rad = kHalfTurn - grid.horizon_zenith_rad;
  // From outside, the air ends at the tangent to its top.
  const double top_dip = h > H ? std::atan2(std::sqrt((h - H) * (2 * R + h + H)), R + H) : 0;
  grid.sky_span_rad = h > H ? dip - top_dip : grid.horizon_zenith_rad;
  // Within about a dip below the horizon the ground comes near at once, which a camera close to the
  // ground sees as a thin band: the rows turn from s^2 to s^4 there.
  grid.ground_bend = std::clamp(0.7 * std::sqrt(dip / grid.ground_span_rad), 0.002, 1.0);
  return grid;
}

SliceGrid slice_grid(const atmosphere::Medium& medium, Length height) {
  const double R = medium.bottom_radius_km, h = height.in(km);
  const double sin_dip = std::sqrt(h * (2 * R + h)) / (R + h);
  // A high camera sees a thin limb and, far below, the terminator at all azimuths: rows double up
  // to 40 km, columns grow with the arc of the ground in view. Measured in docs/atmosphere.md.
  const int zeniths = 128 + 2 * int(64 * std::min(sin_dip / 0.11, 1.0));
  const int azimuths = 64 + 8 * int(24 * sin_dip);
  return slice_grid(medium, height, azimuths, zeniths);
}

SkySlice dark_slice(const atmosphere::Medium& medium, Angle sun_zenith, const SliceGrid& grid,
                    const std::optional<SliceWindow>& window) {
  const std::vector<glm::vec4> dark(size_t(grid.azimuths) * grid.zeniths, glm::vec4(0));
  return {grid, medium.aerosol_g, sun_zenith.in(rad), dark, dark, window};
}

glm::dvec3 SkySlice::radiance_xyz(Angle zenith, Angle azimuth_from_sun) const {
  const double phi = std::abs(std::remainder(azimuth_from_sun.in(rad), 2 * kHalfTurn));
  const double above = grid.horizon_zenith_rad - zenith.in(rad);
  if (above > grid.sky_span_rad) return glm::dvec3(0);
  const int half = grid.zeniths / 2;
  const text::Between y = text::between(grid.share(above) * (half - 1), half - 1);
  const double share = std::pow(std::min(phi / kHalfTurn, 1.0), 2.0 / 3.0);
  const text::Between x = text::between(share * (grid.azimuths - 1), grid.azimuths - 1);
  const size_t corner = size_t(y.node + (above >= 0 ? 0 : half)) * grid.azimuths + x.node;
  const auto lookup = [&](const std::vector<glm::vec4>& texels) {
    const auto at = [&](size_t i) { return glm::dvec3(texels[i]); };
    return (at(corner) * (1 - x.weight) + at(corner + 1) * x.weight) * (1 - y.weight) +
           (at(corner + grid.azimuths) * (1 - x.weight) +
            at(corner + grid.azimuths + 1) * x.weight) *
               y.weight;
  };
  // 1 - nu = 2 sin^2 of half the angle: exact at the sun, where the aerosol phase is steepest.
  const double a = std::sin((zenith.in(rad)-sun_zenith_rad) / 2), b = std::sin(phi / 2);
  const double nu = 1 - 2 * (a * a + std::sin(zenith.in(rad)) * std::sin(sun_zenith_rad) * b * b);
  PhysicsData phase;
  phase.air.aerosol_g = aerosol_g;
  phase.air.aerosol_norm = aerosol_phase_norm(aerosol_g);
  return lookup(smooth) + lookup(aerosol) * Geometry(phase).aerosol_phase(std::max(nu, -1.0));
}

}  // namespace skylapse::sky::bruneton
