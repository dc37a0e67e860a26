#include "sky/bruneton/sun_rows.h"

#include <numbers>

#include "sky/bruneton/physics.h"

namespace skylapse::sky::bruneton {
namespace {

/// Mean height of a component above the ground; 0 if it does not scatter.
double mean_height(const atmosphere::DensityProfile& profile, double top_km, bool scatters) {
  if (!scatters) return 0;
  double sum = 0, moment = 0;
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i) {
    const double h = top_km * (i + 0.5) / kSteps;
    sum += profile.at(h);
    moment += profile.at(h) * h;
  }
  return sum > 0 ? moment / sum : 0;
}

}  // namespace

double scattering_top_km(const atmosphere::Medium& medium) {
  const double H = medium.top_height_km;
  bool air = false, aerosol = false;
  for (const atmosphere::SpectralBand& band : medium.bands) {
    air |= band.rayleigh_scattering_per_km > 0;
    aerosol |= band.aerosol_scattering_per_km > 0;
  }
  const double mean =
      std::max(mean_height(medium.rayleigh, H, air), mean_height(medium.aerosol, H, aerosol));
  return mean > 0 ? std::min(H, 7.55 * mean) : H;
}

SunWarp sun_warp(const atmosphere::Medium& medium) {
  constexpr double kHalfTurn = std::numbers::pi;
  const double R = medium.bottom_radius_km, H = medium.top_height_km;
  // 7.55 mean heights and the shares of the dip below were chosen by convergence for Earth's air up
  // to 60 km: centre 94 deg, width 5 deg, end 114.8 deg. The mean of exp(-h / 8 km) is 7.96 km.
  const double scattering_top = scattering_top_km(medium);
  const auto dip = [&](double h) { return std::acos(R / (R + h)); };
  SunWarp warp{};
  warp.centre_rad = kHalfTurn / 2 + 0.51 * dip(scattering_top);
  warp.width_rad = 0.64 * dip(scattering_top);
  const double dark =
      kHalfTurn / 2 + 3 * dip(H) + 0.15 * dip(H) + 2 * medium.sun_angular_radius_rad;
  warp.dark_end = dark < kHalfTurn;
  warp.end_rad = std::min(dark, kHalfTurn);
  return warp;
}

SunNodes sun_nodes(const atmosphere::Medium& medium, const Settings& settings) {
  const int last = settings.warp_suns() - 1;
  const bool whole_end = settings.first_sun + settings.suns - 1 == last;
  const SunWarp warp = sun_warp(medium);
  return {warp, double(settings.first_sun) / last, 1.0 / last, warp.dark_end && whole_end};
}

void upsample_suns(const double* nodes, size_t node_stride, double* rows, size_t row_stride,
                   int channels, const Settings& settings, bool dark_end) {
  const int last = settings.suns - 1, per = settings.sun_rows_per_interval;
  const auto node = [&](int i, int c) { return nodes[i * node_stride + c]; };
  for (int c = 0; c < channels; ++c) {
    const auto secant = [&](int i) { return node(i + 1, c) - node(i, c); };
    const auto slope = [&](int i) {
      if (i == 0) return secant(0);
      if (i == last) return dark_end ? 0.0 : secant(last - 1);
      return limited_slope(secant(i - 1), secant(i));
    };
    for (int i = 0; i < last; ++i)
      for (int k = 0; k < per; ++k) {
        const double t = double(k) / per, u = 1 - t;
        rows[(size_t(i) * per + k) * row_stride + c] =
            u * u * (1 + 2 * t) * node(i, c) + t * t * (3 - 2 * t) * node(i + 1, c) +
            t * u * u * slope(i) - t * t * u * slope(i + 1);
      }
    rows[size_t(last) * per * row_stride + c] = node(last, c);
  }
}

}  // namespace skylapse::sky::bruneton
