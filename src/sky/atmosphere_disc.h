#pragma once
// The radiance of the sun's disc seen through a computed atmosphere.
#include <glm/glm.hpp>
#include <vector>

#include "core/quantity.h"
#include "sky/atmosphere/medium.h"

namespace skylapse::sky {

/// Exponent alpha of the limb darkening I(m) / I(1) = m^alpha, m = 1 at the centre of the disc.
/// Source   Hestroffer and Magnan 1998, A&A 333, 338, Eq. 6 and 7: -0.507 + 0.441 um / lambda from
///          0.303 to 0.372 um, -0.023 + 0.292 um / lambda from 0.416 to 1.1 um.
/// Changes  linear in wavelength between the two ranges (the Balmer edge lies there); constant
///          outside 0.303..1.1 um.
double limb_darkening_exponent(Wavelength wavelength);

/// Mean of m^alpha over the disc: 2 / (alpha + 2).
double limb_darkening_mean(double exponent);

/// Radiance over the disc: solar irradiance / (pi sin^2 radius), darkened towards the limb about
/// its mean, times the transmittance of the air along each ray.
class AtmosphereDisc {
 public:
  /// `transmittance[i]` holds one value per band of the medium at elevation lowest + i * step of
  /// the view; linear in between, constant beyond.
  AtmosphereDisc(const atmosphere::Medium& medium, Angle radius, Angle lowest, Angle step,
                 const std::vector<std::vector<double>>& transmittance);

  /// XYZ [W m^-2 sr^-1 with CIE weights, 1 au] at a view elevation and the limb variable of
  /// SunDisc.
  [[nodiscard]] glm::dvec3 radiance_xyz(Angle view_elevation, double limb_m) const;

 private:
  std::vector<double> exponents_;  // per band
  double lowest_rad_, step_rad_;
  std::vector<glm::dvec3> colours_;  // [elevation][band]: transmittance * radiance at m = 1 * XYZ
  int elevations_ = 0;
};

}  // namespace skylapse::sky
