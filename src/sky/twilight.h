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

/// Mean luminance of a clear sky, as a camera's meter that looks at the sky would see it: the
/// illuminance by the sky alone over pi, of the Hosek-Wilkie sky at turbidity 2.5 and albedo 0.2.
/// Domain 0..90 deg, constant outside; below the horizon twilight_level continues it.
Luminance mean_clear_sky_luminance(Angle sun_elevation);

/// The same of the computed atmosphere, with the air of a config that says nothing, for a sun
/// anywhere: by sun and air from above -18 deg, whose end of twilight it tends to below, when the
/// night sky's own light is all there is (clear_sky_illuminance at -18 deg, which is added).
/// Source   clear_sky_nodes (benchmarks/slice_image): the double twin, level standard, 16 bands.
Luminance mean_computed_sky_luminance(Angle sun_elevation);

/// Factor on the sky of sun elevation 0 when the sun's true elevation h is below h0, at which the
/// sky model sees the sun on the horizon; 1 from h0 up. The sky keeps its shape and loses light as
/// the published illuminance does, E(h) / E(h0). `sky_at_horizon` is the model's own illuminance
/// at h0 (Hosek-Wilkie gives about three times the measured one): over the first 6 degrees the
/// factor also takes up that difference, so that from there down the illuminance is E(h).
/// Continuous with its slope; monotone for sky_at_horizon above a tenth of E(h0).
double twilight_level(Angle true_elevation, Angle horizon_true_elevation,
                      Illuminance sky_at_horizon);

}  // namespace skylapse::sky
