#include "sky/bruneton/sun_range.h"

#include <algorithm>
#include <cmath>

#include "sky/bruneton/sun_rows.h"

namespace skylapse::sky::bruneton {
namespace {

/// Beyond the horizon's arc: air in view there, and where its light was scattered before.
constexpr Angle kBeyondTheHorizon = 8 * deg;
/// What is lit in twilight is lit, over several scatterings, from where the sun still shines.
constexpr Angle kTwilightSource = 85 * deg;

}  // namespace

Settings restricted_to(SunRange suns, Settings settings, const atmosphere::Medium& medium) {
  settings.suns = settings.warp_suns();
  settings.first_sun = settings.all_suns = 0;
  const int all = settings.suns;
  const SunWarp warp = sun_warp(medium);
  const auto node_of = [&](Angle zenith) {
    const double theta = std::clamp(zenith.in(rad), 0.0, warp.end_rad);
    const double u = std::asinh((warp.centre_rad - theta) / warp.width_rad);
    return (warp.first() - u) / warp.span() * (all - 1);
  };
  // A hundredth of an interval is rounding of the range's own.
  int first = std::clamp(int(std::floor(node_of(suns.lowest) + 0.01)), 0, all - 1);
  int last = std::clamp(int(std::ceil(node_of(suns.highest) - 0.01)), first, all - 1);
  first = std::max(0, std::min(first, last + 1 - kLeastSuns));
  last = std::min(all - 1, std::max(last, first + kLeastSuns - 1));
  if (first == 0 && last == all - 1) return settings;
  settings.first_sun = first;
  settings.suns = last + 1 - first;
  settings.all_suns = all;
  return settings;
}

SunRange sun_range_for(const atmosphere::Medium& medium, Angle lowest, Angle highest,
                       Length height) {
  const double R = medium.bottom_radius_km, h = std::max(0.0, height.in(km));
  const Angle dip = std::atan2(std::sqrt(h * (2 * R + h)), R) * rad;
  const Angle reach = dip + kBeyondTheHorizon;
  return {std::max(std::min(lowest - reach, kTwilightSource), 0 * deg),
          std::min(highest + reach, 180 * deg)};
}

}  // namespace skylapse::sky::bruneton
