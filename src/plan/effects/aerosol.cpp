#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plan/effects/light_bounds.h"
#include "plan/effects/rule.h"
#include "plan/plan.h"

namespace skylapse::plan {
namespace {

/// Greatest share of light that aerosol adds to what air scatters, for equal depths: its phase
/// function's peak over the least of Rayleigh's, 0.75 / (4 pi).
double peak_over_air(double g) {
  const double a = std::min(std::abs(g), 0.99);
  const double peak = 1.5 * (1 - a * a) / (2 + a * a) * 2 / std::pow(1 - a, 3);
  return peak / 0.75;
}

}  // namespace

Verdict judge_aerosol(const Plan& plan, const Frame&) {
  constexpr double kCrossings = 3;
  constexpr double kSeconds =
      0.3e-3;  // a texture more in every slice, a lookup more in every pixel
  const auto& depths = plan.reach.most;
  const auto& air = plan.job.air.description;
  double most = 0, share = 0;
  for (int i = 0; i < AirDepths::kCount; ++i) {
    most = std::max(most, depths.aerosol[i]);
    if (depths.aerosol_scattering[i] > 0)
      share = std::max(share, depths.aerosol_scattering[i] / plan.reach.least.rayleigh[i]);
  }
  if (most == 0) return {false, "its depth is 0", 0, kSeconds};
  const double line =
      air.stratospheric_optical_depth > 0
          ? longest_line_tent(air.planet_radius, air.stratospheric_bottom, air.stratospheric_top)
          : 2 * longest_line_exponential(air.planet_radius, air.aerosol_scale_height);
  // Densest at the ground, where the air is not less dense than the mean of its own 8 km.
  const double concentration =
      air.stratospheric_optical_depth > 0 ? 1e3 : 8 * km / air.aerosol_scale_height;
  const double bound = most * line * kCrossings +
                       share * peak_over_air(air.aerosol_g) * std::max(1.0, concentration);
  return {bound > kLeaveBelow, fmt::format("its depth is up to {:.3g}", most), bound, kSeconds};
}

}  // namespace skylapse::plan
