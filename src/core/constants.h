#pragma once
// Physical constants: one place each, with symbol, value, unit, source and year.
#include "core/quantity.h"

namespace skylapse {

/// Nominal solar angular radius at 1 au: 959.63 arcsec (Auwers 1891; IAU 1976 standard value).
inline constexpr Angle kSolarRadiusAt1Au = 959.63 * arcsec;
/// Mean radius of the Earth, 6371 km (IUGG mean radius R1, 6371.0088 km): the sphere of the
/// atmosphere models. Geodesy uses the WGS84 ellipsoid.
inline constexpr Length kMeanEarthRadius = 6371.0 * km;
/// Radius of the moon: 1737.4 km (IAU WG on Cartographic Coordinates, 2015).
inline constexpr Length kMoonRadius = 1737.4 * km;
/// Luminous efficacy K_m = 683 lm/W at 540 THz (SI, 1979): luminance = 683 * Y.
inline constexpr double kLuminousEfficacy = 683.0;
/// TT - TAI = 32.184 s exactly (IAU 1991).
inline constexpr Duration kTtMinusTai = 32.184 * second;

}  // namespace skylapse
