#pragma once
// The fifteen skies of the CIE standard general sky (CIE S 011/E:2003, ISO 15469:2004; Darula &
// Kittler 2002), with absolute luminance. They say nothing of colour: the dome is white, D65.
#include "core/quantity.h"
#include "core/result.h"
#include "sky/fitted_sky.h"

namespace skylapse::sky::cie {

inline constexpr int kTypes = 15;

/// Types 1 to 6 are covered: no sun, and turbidity means nothing to them.
constexpr bool is_covered(int type) { return type <= 6; }

/// Luminous turbidity that goes with a type from 7 to 15.
/// Source   Kittler, Perez & Darula 1998, table of the fifteen sky types; 12 for "12 and more".
double typical_turbidity(int type);
inline constexpr double kLowestTurbidity = 1, kHighestTurbidity = 12;

/// Relative luminance of a type: indicatrix times gradation over both at the zenith.
/// L / Lz = f(chi) phi(z) / (f(zs) phi(0)); `cos_zenith` below 0 counts as 0.
double relative_luminance(int type, double cos_zenith, Angle chi, Angle sun_zenith);

/// Errors (invalid_input): type outside 1..15, turbidity outside 1..12 (types 7 to 15), sun
/// elevation outside 0..90 deg, NaN in any of them.
Status check(int type, double turbidity, Angle sun_elevation);

/// Luminance of the zenith, of a sun from the horizon to the zenith.
///   covered types  the sky's illuminance, a share of the sun's above the air (133.8 klx times the
///                  sine of its elevation) that the table gives, over that of the relative sky
///   others         A sin(e) + 0.7 (T + 1) sin(e)^C / cos(e)^D + 0.04 T [kcd/m^2], A = A1 T + A2
/// Source   Kittler, Perez & Darula 1998; Darula & Kittler 2002.
/// Changes  the second formula grows without bound towards the zenith and was made for suns up to
///          75 deg: above, the sky keeps the share of the sun's illuminance that it has there.
/// Errors: those of check().
Result<Luminance> zenith_luminance(int type, double turbidity, Angle sun_elevation);

/// Horizontal illuminance of a sky over its zenith luminance [sr], within 1e-3.
double illuminance_over_zenith(int type, Angle sun_zenith);

/// The sky at 1 au. The disc is dimmed by the luminous turbidity: exp(-m T / (9.9 + 0.043 m)), with
/// the air mass m of Kasten & Young 1989 (Clear 1982; Navvab, Karayel, Ne'eman & Selkowitz 1984),
/// the same at all wavelengths; covered skies have none. Errors: as above, and a solar radius
/// outside (0, 10] deg.
Result<FittedSky> make_sky(int type, double turbidity, const Direction<Enu>& sun,
                           Angle solar_radius);

/// Transmittance of the direct beam as above.
double beam_transmittance(double turbidity, Angle elevation);

}  // namespace skylapse::sky::cie
