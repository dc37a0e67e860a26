#pragma once
// One direction of the sky, asked by itself: what probes, tests and the reference share.
#include <vector>

#include "core/quantity.h"

namespace skylapse::sky::bruneton {

struct Query {
  Length height;      // of the observer, >= 0; may be above the atmosphere
  Angle sun_zenith;   // 0..180 deg
  Angle view_zenith;  // 0..180 deg
  Angle azimuth;      // of the view, from the sun's
};

/// Per band of the medium. At 1 au.
struct Answer {
  /// Light scattered into the view ray: no sun disc, no light off the ground at the ray's end
  /// (unless the ground was asked for) [W m^-2 sr^-1 nm^-1].
  std::vector<double> radiance;
  std::vector<double> transmittance;      // along the view ray, to space or to the ground
  std::vector<double> sun_transmittance;  // towards the sun's centre, times the disc's visible part
};

}  // namespace skylapse::sky::bruneton
