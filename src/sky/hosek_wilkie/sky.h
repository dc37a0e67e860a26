#pragma once
// One clear sky with its sun: the questions that images and tables ask.
#include <array>
#include <glm/glm.hpp>

#include "core/frames.h"
#include "core/quantity.h"
#include "core/result.h"
#include "sky/ground_albedo.h"
#include "sky/hosek_wilkie/model.h"
#include "sky/hosek_wilkie/options.h"
#include "sky/hosek_wilkie/solar_disc.h"

namespace skylapse::sky::hosek_wilkie {

/// The Hosek-Wilkie sky of one turbidity, ground albedo and sun elevation.
///
/// All XYZ values use the CIE 1931 functions without normalisation: W m^-2 sr^-1 (or W m^-2), and
/// 683 Y is luminance in cd/m^2 (or illuminance in lux). For Fit::spectral they are the 1 nm sum
/// over 360..830 nm of the bands, linear between them; from 720 to 830 nm the value of 720 nm is
/// held (0.02 % of the weight of Y, 0.05 % of X).
class Sky {
 public:
  /// Errors (invalid_input): turbidity outside 1..10, albedo outside 0..1, sun elevation outside
  /// 0..90 deg, solar radius outside (0, 90) deg; NaN in any of them.
  static Result<Sky> make(Fit fit, SolarFlux flux, double turbidity, const AlbedoSpectrum& albedo,
                          Angle sun_elevation, Angle solar_radius = kReferenceSolarRadius);

  /// Sky without the disc. Not clamped. A view below the horizon is taken on the horizon.
  [[nodiscard]] glm::dvec3 radiance_xyz(const Direction<Enu>& view,
                                        const Direction<Enu>& sun) const;
  /// The same at one wavelength, 320..720 nm; Fit::spectral only (both asserted).
  [[nodiscard]] SpectralRadiance spectral_radiance(Wavelength wavelength,
                                                   const Direction<Enu>& view,
                                                   const Direction<Enu>& sun) const;

  /// Horizontal irradiance by the sky alone, without the disc. Within 2e-4 of the integral
  /// (tested).
  [[nodiscard]] glm::dvec3 diffuse_irradiance_xyz() const;
  /// Irradiance by the disc, cut at the horizon.
  [[nodiscard]] SolarDisc::Irradiance direct_irradiance() const;
  /// Radiance of the Lambertian ground under this sky and sun, reflected band by band.
  [[nodiscard]] glm::dvec3 ground_radiance_xyz() const;

  /// Disc radiance at a view elevation and limb variable (see SolarDisc).
  [[nodiscard]] glm::dvec3 disc_radiance_xyz(Angle view_elevation, double limb) const {
    return disc_.radiance_xyz(view_elevation, limb);
  }
  [[nodiscard]] const SolarDisc& disc() const { return disc_; }

  [[nodiscard]] Fit fit() const { return patterns_.fit; }
  [[nodiscard]] Angle sun_elevation() const { return sun_elevation_; }
  /// What the image path tabulates: XYZ = sum over items of weight * radiance(item).
  [[nodiscard]] const Patterns& patterns() const { return patterns_; }
  [[nodiscard]] const std::array<glm::dvec3, kBandCount>& xyz_weights() const {
    return xyz_weights_;
  }

 private:
  Sky(Patterns patterns, SolarDisc disc, const AlbedoSpectrum& albedo, Angle sun_elevation);
  /// Horizontal irradiance of each band or channel.
  [[nodiscard]] std::array<double, kBandCount> diffuse_irradiance_items() const;

  Patterns patterns_;
  std::array<glm::dvec3, kBandCount> xyz_weights_{};
  SolarDisc disc_;
  AlbedoSpectrum albedo_;
  Angle sun_elevation_;
};

}  // namespace skylapse::sky::hosek_wilkie
