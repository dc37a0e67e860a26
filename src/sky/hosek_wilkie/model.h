#pragma once
// The sky dome of Hosek and Wilkie 2012 ("An Analytic Model for Full Spectral Sky-Dome Radiance",
// ACM TOG 31:4), in double, one band or channel at a time. The judge of the image path.
#include <array>

#include "core/quantity.h"
#include "core/result.h"
#include "sky/ground_albedo.h"
#include "sky/hosek_wilkie/options.h"

namespace skylapse::sky::hosek_wilkie {

/// One band or channel of one sky. Letters as in the paper's formula; `scale` is the radiance
/// unit, W m^-2 sr^-1 nm^-1 for the spectral fit and W m^-2 sr^-1 for the others.
struct Pattern {
  double a = 0, b = 0;  // horizon gradient 1 + A exp(B / (cos theta + 0.01))
  double c = 0;         // constant
  double d = 0, e = 0;  // D exp(E gamma)
  double f = 0;         // F cos^2 gamma
  double g = 0;         // weight of chi(H, gamma)
  double h = 0;         // anisotropy inside chi
  double i = 0;         // weight of sqrt(cos theta)
  double scale = 0;
};

/// scale (1 + A exp(B / (cos theta + 0.01))), cos theta in [0, 1].
double horizon_gradient(const Pattern& pattern, double cos_theta);
/// C + D exp(E gamma) + F cos^2 gamma + G chi, gamma in [0, 180] deg.
double lobes(const Pattern& pattern, Angle gamma, double cos_gamma);
/// Sky radiance at view zenith angle theta in [0, 90] deg and angle gamma in [0, 180] deg from
/// the sun: horizon_gradient * (lobes + I sqrt(cos theta)). Not clamped: within a degree of the
/// horizon the fit can be slightly negative.
double radiance(const Pattern& pattern, Angle theta, Angle gamma);
/// The same with cos theta given; values below 0 (rounding) count as 0.
double radiance(const Pattern& pattern, double cos_theta, Angle gamma);

/// All bands (spectral: 11, 320..720 nm) or channels (XYZ, RGB: 3) of one sky.
struct Patterns {
  Fit fit = Fit::spectral;
  int count = 0;
  std::array<Pattern, kBandCount> items{};
};

struct SkyParameters {
  double turbidity = 2.5;                   // 1..10
  std::array<double, kBandCount> albedo{};  // per band, or per channel in the first three; 0..1
  Angle sun_elevation;                      // 0..90 deg
};

/// Interpolates the published parameters for one sky. Errors (invalid_input): anything outside
/// its domain, NaN included; the message names the value and its range.
Result<Patterns> make_patterns(Fit fit, const SkyParameters& parameters);

/// Radiance between two bands: linear in wavelength. Domain 320..720 nm (asserted), spectral fit.
SpectralRadiance spectral_radiance(const Patterns& patterns, Wavelength wavelength, Angle theta,
                                   Angle gamma);
/// The same with cos theta given; values below 0 (rounding) count as 0.
SpectralRadiance spectral_radiance(const Patterns& patterns, Wavelength wavelength,
                                   double cos_theta, Angle gamma);

/// Albedo per channel of the XYZ and RGB fits: means of the bands, weighted by the matching
/// functions (XYZ) or over 600..700, 500..600 and 420..500 nm (R, G, B).
std::array<double, 3> channel_albedo(Fit fit, const AlbedoSpectrum& albedo);

}  // namespace skylapse::sky::hosek_wilkie
