#pragma once
// Tables of a part of the suns: what a job reads whose frames see the sun within a range.
#include "core/quantity.h"
#include "sky/atmosphere/medium.h"
#include "sky/bruneton/settings.h"

namespace skylapse::sky::bruneton {

/// Zenith angles of the sun, 0..180 deg.
struct SunRange {
  Angle lowest, highest;
};

/// The same settings with the sun nodes that span `suns` and no others, at least kLeastSuns of
/// them. Settings that hold a part already are widened to all first. Rows beyond an end that is not
/// the warp's own read as those at that end.
Settings restricted_to(SunRange suns, Settings settings, const atmosphere::Medium& medium);
inline constexpr int kLeastSuns = 4;

/// The suns that tables must hold for frames whose sun stands at zenith angles from `lowest` to
/// `highest` and whose cameras are at most `height` above the ground. Along a view the local sun
/// differs from the camera's by the arc of the planet in between; light scattered before comes from
/// a little further on, and twilight from where the sun still shines.
/// Bound: slices from such tables differ from those of full tables by at most
/// kPartialTablesError of a value, of values above 0.1 % of the brightest; suns 10 to 108 deg,
/// aerosol depth 0.05 to 0.5, cameras on the ground, at 10 km and 400 km (bench_economies tables).
/// Most of it is one order of scattering less in thick twilight, where the series of a part of the
/// suns converges sooner; otherwise it is below 1e-4.
SunRange sun_range_for(const atmosphere::Medium& medium, Angle lowest, Angle highest,
                       Length height);
inline constexpr double kPartialTablesError = 3e-3;

}  // namespace skylapse::sky::bruneton
