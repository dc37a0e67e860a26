#include "plan/effects/reach.h"

#include <algorithm>
#include <set>

#include "plan/plan.h"

namespace skylapse::plan {
namespace {

void widen(std::array<double, AirDepths::kCount>& most,
           std::array<double, AirDepths::kCount>& least,
           const std::array<double, AirDepths::kCount>& values) {
  for (int i = 0; i < AirDepths::kCount; ++i) {
    most[i] = std::max(most[i], values[i]);
    least[i] = std::min(least[i], values[i]);
  }
}

void add_air(const sky::atmosphere::AirDescription& air, bool first, Reach& reach) {
  const AirDepths depths = depths_of(air);
  if (first) reach.most = reach.least = depths;
  widen(reach.most.rayleigh, reach.least.rayleigh, depths.rayleigh);
  widen(reach.most.aerosol, reach.least.aerosol, depths.aerosol);
  widen(reach.most.aerosol_scattering, reach.least.aerosol_scattering, depths.aerosol_scattering);
  widen(reach.most.ozone, reach.least.ozone, depths.ozone);
  double albedo = air.ground_albedo.value.empty() ? 0.2 : 0;
  for (const double value : air.ground_albedo.value) albedo = std::max(albedo, value);
  reach.greatest_albedo = std::max(reach.greatest_albedo, albedo);
}

}  // namespace

Reach reach_of(const Plan& plan) {
  Reach reach;
  const bool changes = !plan.air.sites.empty();
  std::set<std::pair<int, int>> seen;  // air that stands still: one frame of each will do
  bool first = true;
  for (const Frame& frame : plan.frames) {
    const Angle sun = elevation(frame.sun.direction);
    reach.lowest_sun = first ? sun : std::min(reach.lowest_sun, sun);
    reach.highest_sun = first ? sun : std::max(reach.highest_sun, sun);
    const Length height = frame.camera_height;
    reach.lowest_camera = first ? height : std::min(reach.lowest_camera, height);
    reach.highest_camera = first ? height : std::max(reach.highest_camera, height);
    if (changes || seen.emplace(frame.turbidity, frame.albedo).second)
      add_air(air_of_frame(plan.job, plan.air, frame), first, reach);
    first = false;
  }
  return reach;
}

}  // namespace skylapse::plan
