#pragma once
// The medium as arrays over bands, padded for the inner loops, with its shells and phase functions.
#include <array>

#include "sky/monte_carlo/kernels.h"
#include "sky/monte_carlo/phase.h"
#include "sky/monte_carlo/shells.h"
#include "sky/monte_carlo/sun_guide.h"

namespace skylapse::sky::monte_carlo {

/// How much of the sun a point sees.
enum class SunVisibility {
  /// A smooth step of the sun's centre across the horizon, light from the centre: what the
  /// tabulated models compute, and therefore the default.
  smooth_step,
  /// Uniformly bright disc, each path sees one random point of it.
  disc,
};

/// Light from the sun that reaches a point.
struct SunView {
  double visible = 0;  // share of the disc, 0..1
  PerBand transmittance;
};

class Optics {
 public:
  explicit Optics(const atmosphere::Medium& medium,
                  AerosolShape shape = AerosolShape::cornette_shanks);

  int bands, padded;
  PerBand solar, rayleigh, aerosol, extinction_aerosol, ozone, albedo;
  Shells shells;
  RayleighPhase rayleigh_phase;
  AerosolPhase aerosol_phase;
  double sun_radius;  // rad
  bool has_aerosol;
  /// Means over the bands: Rayleigh and aerosol scattering, and the three extinctions.
  double mean_rayleigh = 0, mean_aerosol = 0, mean_extinction_aerosol = 0, mean_ozone = 0;
  SunGuide guide;

  void transmittances(const Columns& columns, PerBand& out) const {
    kernel::transmittances(padded, rayleigh.data(), extinction_aerosol.data(), ozone.data(),
                           columns, out.data());
  }
  /// Optical depth of one band.
  [[nodiscard]] double depth(const Columns& c, int band) const {
    const auto b = size_t(band);
    return rayleigh[b] * c.rayleigh + extinction_aerosol[b] * c.aerosol + ozone[b] * c.ozone;
  }

  /// Optical depth at the mean coefficients.
  [[nodiscard]] double mean_depth(const Columns& c) const {
    return mean_rayleigh * c.rayleigh + mean_extinction_aerosol * c.aerosol + mean_ozone * c.ozone;
  }

  /// What a point at `height` sees of a sun at zenith cosine `mu_sun`. transmittance is not set
  /// where nothing is visible.
  void view_sun(double height, double mu_sun, SunVisibility rule, SunView& view) const;
  /// Share of the sun's perpendicular irradiance that falls on horizontal ground; its transmittance
  /// into `view` as above. smooth_step: mean cosine of the disc's part above the horizon.
  double sun_on_ground(double height, double mu_sun, SunVisibility rule, SunView& view) const;
};

}  // namespace skylapse::sky::monte_carlo
