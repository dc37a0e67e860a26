#pragma once
// Slices made up for tests of the pixel loop: as steep as real ones, without an atmosphere.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/frames.h"
#include "sky/bruneton/sky_slice.h"

namespace skylapse::sky::bruneton {

inline constexpr double kPi = std::numbers::pi;

struct MadeUpSky {
  std::string name;
  SkySlice slice;
  Direction<Enu> sun;
};

/// The slice's mapping as its header states it, bilinear in double; with the aerosol's phase.
inline glm::dvec3 looked_up(const SkySlice& slice, double over, double azimuth) {
  const SliceGrid& grid = slice.grid;
  const int half = grid.zeniths / 2;
  if (over > grid.sky_span_rad * (1 + 1e-12)) return glm::dvec3(0);
  const double span = over < 0 ? grid.ground_span_rad : grid.sky_span_rad;
  const double b = over < 0 ? grid.ground_bend : grid.sky_bend;
  const double q = std::min(1.0, std::abs(over) / span);
  // b s^2 + (1 - b) s^4 = q
  const double s2 = b < 1 ? (std::sqrt(b * b + 4 * (1 - b) * q) - b) / (2 * (1 - b)) : q;
  const double t = std::sqrt(std::min(1.0, s2)) * (half - 1);
  const double u = std::pow(std::min(1.0, azimuth / kPi), 2.0 / 3) * (grid.azimuths - 1);
  const int row = std::min(int(t), half - 2), column = std::min(int(u), grid.azimuths - 2);
  const auto read = [&](const std::vector<glm::vec4>& nodes) {
    const auto at = [&](int r, int c) {
      return glm::dvec3(
          nodes[size_t(row + r + (over < 0 ? half : 0)) * grid.azimuths + column + c]);
    };
    const double f = u - column, g = t - row;
    return (1 - g) * ((1 - f) * at(0, 0) + f * at(0, 1)) + g * ((1 - f) * at(1, 0) + f * at(1, 1));
  };
  const double zenith = grid.horizon_zenith_rad - over, g = slice.aerosol_g;
  const double nu = std::cos(zenith) * std::cos(slice.sun_zenith_rad) +
                    std::sin(zenith) * std::sin(slice.sun_zenith_rad) * std::cos(azimuth);
  const double phase = 3 / (8 * kPi) * (1 - g * g) / (2 + g * g) * (1 + nu * nu) /
                       std::pow(1 + g * g - 2 * g * nu, 1.5);
  return read(slice.smooth) + phase * read(slice.aerosol);
}

/// The horizon and the limb of a camera at `height_km` over a planet of 6371 km with 100 km of air.
inline SliceGrid grid_at(double height_km, int azimuths, int zeniths) {
  constexpr double kRadius = 6371, kTop = 100;
  const double r = kRadius + height_km;
  const double dip = std::atan2(std::sqrt(height_km * (2 * kRadius + height_km)), kRadius);
  const double bend = std::clamp(2 * dip, 0.01, 1.0);
  SliceGrid grid{azimuths, zeniths, kPi / 2 + dip, kPi / 2 + dip, kPi / 2 - dip, 0.6, bend};
  if (height_km > kTop)
    grid.sky_span_rad = std::asin((kRadius + kTop) / r) - std::asin(kRadius / r);
  return grid;
}

/// Radiance that falls by e from every few rows to the next and swings with the azimuth; some of
/// the colours become negative in another space.
inline MadeUpSky made_up_sky(double height_km, double sun_zenith_deg, double sun_azimuth_deg,
                             double g) {
  MadeUpSky sky;
  sky.name = "height " + std::to_string(height_km) + " km, sun " + std::to_string(sun_zenith_deg) +
             ", g " + std::to_string(g);
  sky.sun = enu_direction(sun_azimuth_deg * deg, (90 - sun_zenith_deg) * deg);
  SkySlice& slice = sky.slice;
  slice.grid = grid_at(height_km, 24, 32);
  slice.aerosol_g = g;
  slice.sun_zenith_rad = sun_zenith_deg * kPi / 180;
  const int half = slice.grid.zeniths / 2;
  for (int row = 0; row < slice.grid.zeniths; ++row) {
    const double s = double(row % half) / (half - 1);
    const bool ground = row >= half;
    for (int column = 0; column < slice.grid.azimuths; ++column) {
      const double x = double(column) / (slice.grid.azimuths - 1);
      // At the zenith and the nadir there is one value for all azimuths.
      const double swing = 1 + 0.5 * (1 - s * s) * std::cos(kPi * std::pow(x, 1.5));
      const double level = ground ? 0.4 * std::exp(-0.7 * s) : std::exp(-2.5 * s);
      const glm::dvec3 smooth = level * swing * glm::dvec3(0.9 - 0.4 * s, 0.8, 0.3 + 0.9 * s);
      const glm::dvec3 aerosol = 0.2 * std::exp(-4 * s) * swing * glm::dvec3(1.0, 0.9, 0.7);
      slice.smooth.emplace_back(glm::vec4(glm::vec3(smooth), 0));
      slice.aerosol.emplace_back(glm::vec4(glm::vec3(aerosol), 0));
    }
  }
  return sky;
}

/// On the ground, on a mountain, in an airliner, in orbits, and far out; every kind of sun; every
/// kind of aerosol.
inline std::vector<MadeUpSky> made_up_skies() {
  return {made_up_sky(0, 30, 200, 0.7),       made_up_sky(0.001, 90, 77, 0.8),
          made_up_sky(0, 0, 0, 0.7),          made_up_sky(11, 95, 181, 0.99),
          made_up_sky(3, 108, 13, -0.5),      made_up_sky(99.999, 60, 300, 0),
          made_up_sky(400, 70, 250, 0.8),     made_up_sky(400, 180, 0, 0.7),
          made_up_sky(36000, 100, 140, 0.76), made_up_sky(400000, 91, 20, 0.9)};
}

}  // namespace skylapse::sky::bruneton
