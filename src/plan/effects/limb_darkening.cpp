#include <fmt/format.h>

#include <numbers>

#include "plan/effects/light_bounds.h"
#include "plan/effects/rule.h"
#include "plan/plan.h"

namespace skylapse::plan {

/// The light of a darkened disc lies nearer to its middle: to even it out each bit moves, on the
/// mean, by at most 0.057 radii (m^alpha with alpha up to 0.72, the Wasserstein distance of the
/// radial distributions). A pixel's tent falls by at most sqrt(2) a pixel, so no pixel's share
/// changes by more than 0.057 sqrt(2) radii in pixels.
Verdict judge_limb_darkening(const Plan& plan, const Frame& frame) {
  constexpr double kMoved = 0.057;
  constexpr double kSeconds = 1e-5;
  if (!judge_sun_disc(plan, frame).called_for) return {false, "no disc is drawn", 0, kSeconds};
  const double radius_px = frame.sky.sun_radius / plan.pixels[frame.camera].smallest;
  const double bound = disc_change_bound(plan, frame, kMoved * std::numbers::sqrt2 * radius_px);
  return {bound > kLeaveBelow, fmt::format("the disc's radius is {:.2f} pixels", radius_px), bound,
          kSeconds};
}

}  // namespace skylapse::plan
