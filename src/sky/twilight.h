#pragma once
// How bright a clear sky is when the sun is below the horizon.
#include "core/quantity.h"

namespace skylapse::sky {

/// Horizontal illuminance by sun and clear sky at sea level.
/// Source   polynomials of USNO Circular 171 (Janiczek and DeYoung 1987), whose pieces jump by up
/// to
///          1 % where they meet; here their values at nodes, joined by a monotone C1 curve in log
///          E.
/// Domain   true (unrefracted) elevation of the sun's centre, -90..90 deg; constant below -18 deg,
///          where the night sky's own light takes over.
/// Error    within 0.6 % of the polynomials; 4 % in the last half degree above -18 deg, where the
///          curve bends into the constant (tested).
Illuminance clear_sky_illuminance(Angle true_sun_elevation);

/// Factor on the sky of sun elevation 0 when the sun's true elevation is `true_elevation`:
/// E(h) / E(h0) below h0, the true elevation at which the sky model sees the sun on the horizon;
/// 1 from there up. Continuous and monotone.
double twilight_level(Angle true_elevation, Angle horizon_true_elevation);

}  // namespace skylapse::sky
