#pragma once
// The extremes of a job, for decisions that hold for all its frames.
#include "plan/effects/light_bounds.h"
#include "plan/effects/view_reach.h"

namespace skylapse::plan {

/// Over all frames, however few of them a run renders: shards must not differ.
struct Reach {
  AirDepths most, least;  // of all airs, one by one
  double greatest_albedo = 0;
  Angle lowest_sun, highest_sun;         // of the sun that lights the air
  Length lowest_camera, highest_camera;  // above the ground of the atmosphere
};
Reach reach_of(const Plan& plan);

}  // namespace skylapse::plan
