#pragma once
// Random scenes of the whole domain in which the planner makes promises.
#include <cstdint>
#include <vector>

#include "core/quantity.h"
#include "sky/atmosphere/atmosphere.h"

namespace skylapse::study {

/// One sky: where the camera is, where the sun stands, what the air is.
struct AccuracyScene {
  Angle sun_elevation;  // as seen, over the horizontal
  Length height;
  sky::atmosphere::AirDescription air;
  double ground_albedo = 0.2;  // grey, also in `air`
};

/// Scene number `index` of a seed: sun at +80 to -12 deg (a third of them below the horizon),
/// camera at 0 to 12 km, some at 40 and 400 km, aerosol depth 0 to 1.5, albedo 0 to 0.9, ozone 200
/// to 450 DU; half of them with aerosol of another kind (g 0.55 to 0.85, single-scattering albedo
/// 0.8 to 1, Angstrom exponent 0.3 to 2).
AccuracyScene draw_scene(uint64_t seed, int index);

}  // namespace skylapse::study
