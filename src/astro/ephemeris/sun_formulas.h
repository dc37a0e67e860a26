#pragma once
// The cheaper rungs of the ladder: closed formulas for the sun's place, without ERFA.
#include "astro/sky_state.h"
#include "astro/time/time_scales.h"

namespace skylapse::astro {

struct FormulaSun {
  Direction<Enu> direction;
  Length distance;  // geocentric
  Angle declination;
};

/// SG2.
/// Source  Blanc & Wald 2012, "The SG2 algorithm for a fast and accurate computation of the
///         position of the Sun for multi-decadal time period", Solar Energy 86, 3072-3083.
/// Domain  1980..2030 with an error below 0.003 deg; it drifts away slowly outside.
/// Changes TT - UT1 comes from our own clock instead of the paper's polynomials; hour angle and
///         declination end in a vector instead of an arcsine.
FormulaSun sg2_sun(const AstronomicalTime& time, const GeodeticPosition& observer);

/// Which arctangent turns the formula's two sides into an azimuth.
enum class AzimuthBranch {
  full_circle,  // atan2
  half_circle,  // the thesis's arctan of the quotient: range (-90, 90) deg about south
};

/// The thesis's formulas.
/// Source  Preetham, Shirley & Smits 1999, "A Practical Analytic Model for Daylight", appendix
///         A.6, as the seed thesis quotes them in its section 3.2, (3.1)-(3.3).
/// Input   J is the day of the year (1 = 1 January); the clock is the standard time of the nearest
///         meridian that is a multiple of 15 deg, so the date changes near the local midnight.
/// Changes signs: the longitude is positive to the east; the denominator of (3.2) is
///         -(cos l sin d + sin l cos d cos(pi t / 12)), the sun's component to the south (printed
///         with the first sign lost).
/// Error   up to 1.3 deg with the full circle. With the half circle the azimuth is off by 180 deg
///         whenever the sun stands in the northern half of the sky: the published flaw, kept.
FormulaSun preetham_sun(const Instant& instant, const GeodeticPosition& observer,
                        AzimuthBranch branch);

}  // namespace skylapse::astro
