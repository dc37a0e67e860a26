#include "config/air_conversion.h"

#include <cmath>

namespace skylapse::config {
namespace {

constexpr double kContrast = 3.912;            // -ln 0.02
constexpr double kRayleighPerMetre = 1.15e-5;  // 550 nm, sea level
constexpr double kAerosolScaleHeightM = 1200;  // Preetham et al. 1999: 0.83 per km
constexpr double kAngstromExponent = 1.3;
constexpr double kWavelengthUm = 0.55;
constexpr double kBetaSlope = 0.04608, kBetaOffset = -0.04586;

constexpr double kStandardPressureHpa = 1013.25;

double rayleigh_per_metre(const sky::atmosphere::AirDescription& air) {
  return kRayleighPerMetre * air.surface_pressure.in(hPa) / kStandardPressureHpa;
}

double angstrom_factor() { return std::pow(kWavelengthUm, kAngstromExponent); }

}  // namespace

double turbidity_from_aerosol_depth(double depth) {
  return (depth * angstrom_factor() - kBetaOffset) / kBetaSlope;
}

double aerosol_depth_from_turbidity(double turbidity) {
  return (kBetaSlope * turbidity + kBetaOffset) / angstrom_factor();
}

double turbidity_from_visibility(Length visibility) {
  const double aerosol_per_metre = kContrast / visibility.in(metre)-kRayleighPerMetre;
  return turbidity_from_aerosol_depth(aerosol_per_metre * kAerosolScaleHeightM);
}

Length visibility_from_turbidity(double turbidity) {
  const double aerosol_per_metre = aerosol_depth_from_turbidity(turbidity) / kAerosolScaleHeightM;
  return kContrast / (aerosol_per_metre + kRayleighPerMetre) * metre;
}

double aerosol_depth_from_visibility(Length visibility,
                                     const sky::atmosphere::AirDescription& air) {
  const double aerosol_per_metre = kContrast / visibility.in(metre)-rayleigh_per_metre(air);
  const double column_m =
      sky::atmosphere::exponential_profile(air.aerosol_scale_height, air.top_height)
          .vertical_column_km(air.top_height.in(km)) *
      km.factor;
  return aerosol_per_metre * column_m;
}

Length greatest_visibility(const sky::atmosphere::AirDescription& air) {
  return kContrast / rayleigh_per_metre(air) * metre;
}

}  // namespace skylapse::config
