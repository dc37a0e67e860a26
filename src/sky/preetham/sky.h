#pragma once
// The sky of Preetham, Shirley & Smits 1999 ("A Practical Analytic Model for Daylight", SIGGRAPH
// 99, appendix A): luminance and chromaticity by Perez's formula. A baseline, not a good sky; its
// limits are in docs/physics/baselines.md.
#include "core/result.h"
#include "sky/fitted_sky.h"

namespace skylapse::sky::preetham {

/// Turbidities in which the luminance is positive in every direction for every sun from the horizon
/// to the zenith (tested). The authors fitted 2 to 6. Below, 1 + A exp(B) turns negative; above,
/// the zenith of a low sun soon does.
inline constexpr double kLowestTurbidity = 1.7, kHighestTurbidity = 10;

/// CIE xyY of a direction; Y in kcd/m^2.
struct Xyy {
  double x = 0, y = 0, luminance = 0;
};

class Model {
 public:
  /// Errors (invalid_input): turbidity outside the range above, sun outside 0..90 deg of elevation.
  static Result<Model> make(double turbidity, Angle sun_elevation);

  [[nodiscard]] const Xyy& zenith() const { return zenith_; }
  /// `cos_zenith` of the view, below 1e-3 taken as that; `gamma` from the view to the sun.
  [[nodiscard]] Xyy at(double cos_zenith, Angle gamma) const;

 private:
  /// F(theta, gamma) = (1 + A exp(B / cos theta)) (1 + C exp(D gamma) + E cos^2 gamma).
  struct Perez {
    double a = 0, b = 0, c = 0, d = 0, e = 0;
    [[nodiscard]] double at(double cos_zenith, double gamma) const;
  };
  Perez luminance_, x_, y_;
  Xyy zenith_;
  Xyy scale_;  // zenith over F(0, sun's zenith angle)
};

/// Transmittance of the direct beam: molecules, aerosol of Angstrom's beta = 0.04608 T - 0.04586
/// with exponent 1.3, and ozone, over the relative optical mass of an apparent elevation (the
/// paper's appendix, after Iqbal 1983).
/// Changes  0.3 atm cm of ozone with this project's cross sections in place of 0.35 and a table;
///          water vapour and mixed gases, which absorb little that the eye sees, are left out.
double beam_transmittance(double turbidity, Wavelength wavelength, Angle elevation);

/// The sky with its disc at 1 au. Errors: those of Model::make; solar radius outside (0, 10] deg.
Result<FittedSky> make_sky(double turbidity, const Direction<Enu>& sun, Angle solar_radius);

}  // namespace skylapse::sky::preetham
