#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plan/effects/light_bounds.h"
#include "plan/effects/rule.h"
#include "plan/plan.h"
#include "plan/rates.h"

namespace skylapse::plan {
namespace {

/// Elevation of the top of the air as seen from above it; the zenith from within.
Angle top_of_air(const Plan& plan, const Frame& frame) {
  const auto& air = plan.job.air.description;
  if (frame.camera_height <= air.top_height) return 90 * deg;
  return horizon_elevation(frame.camera_height - air.top_height,
                           air.planet_radius + air.top_height);
}

/// Greatest depth by scattering along any line: both components at their longest.
double longest_line_depth(const Plan& plan) {
  const auto& air = plan.job.air.description;
  const auto& depths = plan.reach.most;
  double depth = 0;
  const double air_line = 2 * longest_line_exponential(air.planet_radius, 5 * km);
  double haze_line = 2 * longest_line_exponential(air.planet_radius, air.aerosol_scale_height);
  if (air.stratospheric_optical_depth > 0)
    haze_line = std::max(haze_line, longest_line_tent(air.planet_radius, air.stratospheric_bottom,
                                                      air.stratospheric_top));
  for (int i = 0; i < AirDepths::kCount; ++i)
    depth =
        std::max(depth, depths.rayleigh[i] * air_line + depths.aerosol_scattering[i] * haze_line);
  return depth;
}

}  // namespace

/// Light scattered once is at most E P t along a line of depth t, and the sunlit ground A E / pi;
/// scattered again along a line it is at most t times the greatest radiance about, and so on:
///   L <= t (E P t + A E / pi) / (1 - t - A).
/// The ground under single scattering lacks the light of the sky, A E P t at most.
Verdict judge_multiple_scattering(const Plan& plan, const Frame& frame) {
  const double seconds = rates::multiple_scattering_seconds(plan);
  if (plan.model == config::SkyModel::single_scattering)
    return {false, "left out by sky.model: single-scattering", {}, 0, false};
  if (plan.views[frame.camera].lowest > top_of_air(plan, frame))
    return {false,
            fmt::format("no pixel sees the air, which ends at {:.2f} deg",
                        top_of_air(plan, frame).in(deg)),
            0, seconds};
  const auto& air = plan.job.air.description;
  const double t = longest_line_depth(plan), albedo = plan.reach.greatest_albedo;
  const double g = std::min(std::abs(air.aerosol_g), 0.99);
  const double peak =
      std::max(0.12, 3 * (1 - g * g) / (2 + g * g) / std::pow(1 - g, 3) / (4 * std::numbers::pi));
  std::optional<double> bound;
  if (t + albedo < 1) {
    const double once = peak * t + albedo / std::numbers::pi;
    bound = kSolarY * frame.sun.distance_factor * (t * once + albedo * peak * t) /
            (1 - t - albedo) / darkest_step(frame);
  }
  return {!bound || *bound > kLeaveBelow,
          fmt::format("the depth of the longest line is up to {:.3g}", t), bound, seconds};
}

}  // namespace skylapse::plan
