#pragma once
// How much the air lifts a body above its true place.
#include "astro/sky_state.h"

namespace skylapse::astro {

/// Below this true elevation the formula is left and refraction fades out.
inline constexpr Angle kRefractionFormulaEnd = -1.0 * deg;
/// True elevation at and below which there is no refraction any more (end of civil twilight).
inline constexpr Angle kRefractionFadeEnd = -6.0 * deg;

/// Refraction R of a body at true (airless) elevation h: apparent elevation = h + R.
/// Source  Saemundsson 1986, Sky & Telescope 72, 70, in the form of Meeus 1998, ch. 16:
///         R = 1.02' / tan(h + 10.3 / (h + 5.11)) * P / 1010 hPa * 283 K / (273 K + T), h in deg.
/// Domain  h in [-90, 90] deg, any pressure >= 0, temperature above -273 degC (asserted).
/// Changes (1) never negative: the bare formula gives -0.11" within 0.11 deg of the zenith, which
///         would push a body there down along an undefined azimuth;
///         (2) below -1 deg, where the formula was not fitted (it has a pole at -5.11 deg), a cubic
///         that keeps value and slope at -1 deg and ends flat at 0 at -6 deg.
/// Returns 0 if refraction is not enabled. R is continuous, and h + R grows with h (tested).
Angle refraction(Angle true_elevation, const RefractionConditions& conditions);

/// `direction` lifted by refraction() in its own vertical plane.
Direction<Enu> lift_by_refraction(const Direction<Enu>& direction,
                                  const RefractionConditions& conditions);

/// Height over width of a disc of that radius about a centre at a true elevation: refraction lifts
/// its lower limb more than its upper. 1 where there is none, about 0.83 on the horizon at 10 degC
/// and 1010 hPa. Positive, and at most 1: where refraction fades out below -1 deg, which is no
/// physics, it would stretch the disc.
double flattening(Angle true_elevation, Angle radius, const RefractionConditions& conditions);

}  // namespace skylapse::astro
