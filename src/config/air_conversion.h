#pragma once
// Other measures of haze as the turbidity of the sky models. All at 550 nm.
#include "core/quantity.h"
#include "sky/atmosphere/atmosphere.h"

namespace skylapse::config {

/// Turbidity that gives the vertical aerosol optical depth `depth` (>= 0) at 550 nm.
/// Source   Angstrom's law with exponent 1.3 to 1000 nm, then Preetham et al. 1999, appendix A.1:
///          beta = 0.04608 T - 0.04586.
/// Returns  any value from 0.995 (no aerosol) up; the sky models take 1 to 10.
double turbidity_from_aerosol_depth(double depth);

/// The inverse.
double aerosol_depth_from_turbidity(double turbidity);

/// Turbidity of air with the meteorological range `visibility` (> 0).
/// Source   Koschmieder 1924 with 2 % contrast: extinction at the ground = 3.912 / visibility, of
///          which air molecules take 1.15e-5 per metre (Bodhaine et al. 1999, sea level, 15 C); the
///          rest is aerosol, which falls off with a scale height of 1200 m (Preetham et al. 1999).
/// Returns  less than 1 where the range is beyond that of clean air.
double turbidity_from_visibility(Length visibility);

/// The inverse.
Length visibility_from_turbidity(double turbidity);

/// Vertical aerosol optical depth that leaves the meteorological range `visibility` (> 0) at the
/// ground of `air`, with its scale height, pressure and top; its own depth is not looked at.
/// Source   Koschmieder as above; molecules take 1.15e-5 per metre times surface pressure over
///          1013.25 hPa.
/// Returns  less than 0 where the range is beyond that of air without aerosol.
double aerosol_depth_from_visibility(Length visibility, const sky::atmosphere::AirDescription& air);

/// The inverse for air without aerosol: the greatest range there is; infinite without air.
Length greatest_visibility(const sky::atmosphere::AirDescription& air);

}  // namespace skylapse::config
