#pragma once
// The solar disc of Hosek and Wilkie 2013 ("Adding a Solar-Radiance Function to the Hosek-Wilkie
// Skylight Model", IEEE CG&A 33:3), seen through the atmosphere from the ground.
#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "core/quantity.h"
#include "core/result.h"
#include "sky/ground_albedo.h"
#include "sky/hosek_wilkie/options.h"

namespace skylapse::sky::hosek_wilkie {

/// Angular radius of the disc the model was made with.
inline constexpr Angle kReferenceSolarRadius = 0.255 * deg;

/// The disc for one turbidity, ready to evaluate (about 0.1 us per XYZ radiance).
///
/// Elevation is that of the view direction, not of the sun's centre: that makes the gradient on a
/// setting sun. Below the horizon (negative elevation) there is no direct light: 0.
/// With another radius R the radiance is the reference's times (sin 0.255 deg / sin R)^2, so the
/// flux of the sun does not depend on the size at which it is drawn.
class SolarDisc {
 public:
  /// Errors: turbidity outside 1..10 or NaN; radius outside (0, 90) deg.
  static Result<SolarDisc> make(double turbidity, SolarFlux flux,
                                Angle radius = kReferenceSolarRadius);

  [[nodiscard]] Angle radius() const { return radius_; }

  /// m = sqrt(1 - (sin gamma / sin R)^2) for the angle gamma to the sun's centre: 1 at the centre,
  /// towards 0 at the limb; nothing at the limb and outside. Only gamma < 90 deg can be inside.
  [[nodiscard]] std::optional<double> limb_variable(Angle gamma) const;

  /// Radiance at 320..720 nm (asserted), view elevation up to 90 deg, limb variable in [0, 1].
  [[nodiscard]] SpectralRadiance radiance(Wavelength wavelength, Angle view_elevation,
                                          double limb) const;

  /// W m^-2 sr^-1 with CIE 1931 weights, not normalised: 683 Y is cd/m^2.
  [[nodiscard]] glm::dvec3 radiance_xyz(Angle view_elevation, double limb) const;

  /// Irradiance by the disc centred at `sun_elevation`; the part below the horizon is cut away.
  struct Irradiance {
    glm::dvec3 normal_xyz{0};                           // on a surface facing the sun, W m^-2
    glm::dvec3 horizontal_xyz{0};                       // on the ground
    std::array<double, kBandCount> horizontal_bands{};  // W m^-2 nm^-1, at the band centres
  };
  /// By Gauss quadrature; within 1e-4 of the full integral, 1e-3 while the horizon cuts the disc.
  [[nodiscard]] Irradiance irradiance(Angle sun_elevation) const;

 private:
  SolarDisc() = default;
  using Bands = std::array<double, kBandCount>;
  [[nodiscard]] Bands unlimbed_bands(Angle view_elevation) const;
  [[nodiscard]] static Bands limb_bands(double limb);

  Angle radius_;
  double radius_factor_ = 1;
  SolarFlux flux_ = SolarFlux::reference;
  std::array<std::array<std::array<double, 4>, 45>, kBandCount> pieces_{};  // k3 k2 k1 k0
  // XYZ = sum over S_i l_i W0 + (S_i l_i+1 + S_i+1 l_i) W1, from the products of the linear
  // interpolations of S and l between bands.
  std::array<glm::dvec3, kBandCount> same_band_{};
  std::array<glm::dvec3, kBandCount> next_band_{};
};

}  // namespace skylapse::sky::hosek_wilkie
