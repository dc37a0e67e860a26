#pragma once
// Bounds on light and air that rules are made of. Radiances are Y in W m^-2 sr^-1: 1.0 is 683
// cd/m^2.
#include <array>

#include "core/quantity.h"
#include "sky/atmosphere/atmosphere.h"

namespace skylapse::plan {

struct Frame;
struct Plan;

/// Radiance of the least value above black that an 8-bit sRGB display shows at the planned
/// exposure: 1 / (255 * 12.92) of white (IEC 61966-2-1).
double darkest_step(const Frame& frame);

/// Vertical optical depths of an air at the wavelengths of kDepthWavelengths.
struct AirDepths {
  static constexpr int kCount = 9;
  std::array<double, kCount> rayleigh{}, aerosol{}, aerosol_scattering{}, ozone{};

  [[nodiscard]] double greatest_scattering() const;  // air and aerosol
  [[nodiscard]] double least_extinction() const;     // all three
};
/// From one end of the bands to the other, with the maximum of ozone between.
inline constexpr std::array<double, AirDepths::kCount> kDepthWavelengths{360, 400, 450, 500, 550,
                                                                         602, 650, 700, 830};
AirDepths depths_of(const sky::atmosphere::AirDescription& air);

/// Greatest optical depth of any straight line that the planet does not cut, over the vertical one,
/// of a component that lies in bottom..top: sqrt(2 pi R / H) twice for an exponential, the longest
/// chord at the peak density for a layer.
double longest_line_exponential(Length planet_radius, Length scale_height);
double longest_line_tent(Length planet_radius, Length bottom, Length top);

/// Solar illuminance on a surface that faces the sun above the air at 1 au, as Y: CIE weights of
/// data/spectral's sun, rounded up.
inline constexpr double kSolarY = 200;

/// Upper bound on the light of the disc on a surface that faces it, and of its share
/// that a change of the disc of `share` (of its flux) moves in a pixel, over the darkest step.
double disc_light_bound(const Plan& plan, const Frame& frame);
double disc_change_bound(const Plan& plan, const Frame& frame, double share);

}  // namespace skylapse::plan
