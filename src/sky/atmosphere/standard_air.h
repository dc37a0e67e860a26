#pragma once
// How the number density of the air falls with height in the standard atmosphere.
#include "sky/atmosphere/density_profile.h"

namespace skylapse::sky::atmosphere {

/// Number density relative to the ground, as eight joined pieces (exponential + straight line).
/// Source   U.S. Standard Atmosphere, 1976 (COESA): the temperature layers up to 86 km, the table
/// of
///          number densities to 100 km. The pieces join at the layers' ends.
/// Error    less than 0.14 % up to 86 km, 0.4 % up to 100 km; above, the last piece's exponential
///          goes on (scale height 5.6 km; 35 % low at 120 km).
/// Domain   `top` above the ground; the density is 0 from there on. The density is continuous
/// below.
DensityProfile standard_air_profile(Length top);

}  // namespace skylapse::sky::atmosphere
