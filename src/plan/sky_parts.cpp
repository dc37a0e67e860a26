#include "plan/sky_parts.h"

#include <algorithm>
#include <cmath>

namespace skylapse::plan {
namespace {

/// Rows and columns of looks: the shares are good to some percent, which is what bounds are.
constexpr int kAcross = 20, kDown = 20;

/// Whether two directions lie on the same side; a sun in the zenith has no side and no other.
bool on_the_suns_side(const Direction<Enu>& view, const Direction<Enu>& sun) {
  return view.x() * sun.x() + view.y() * sun.y() >= 0;
}

}  // namespace

std::optional<SkyPart> part_of(const Direction<Enu>& view, const Direction<Enu>& sun,
                               Angle horizon) {
  const Angle above = elevation(view) - horizon;
  if (above < 0 * deg) return {};
  if (separation(view, sun) < kAureoleRadius) return SkyPart::aureole;
  const bool sunward = on_the_suns_side(view, sun);
  if (above < kHorizonBand) return sunward ? SkyPart::horizon_sunward : SkyPart::horizon_away;
  if (above < kLowSky) return sunward ? SkyPart::low_sunward : SkyPart::low_away;
  return SkyPart::high;
}

CameraSky::CameraSky(const image::Camera& camera) {
  // A cell stands for its pixels: the solid angle of the middle one times their number.
  const int across = std::min(camera.width, kAcross), down = std::min(camera.height, kDown);
  for (int row = 0; row < down; ++row)
    for (int column = 0; column < across; ++column) {
      const int x = (2 * column + 1) * camera.width / (2 * across);
      const int y = (2 * row + 1) * camera.height / (2 * down);
      const auto toward = image::direction_at(camera, {x + 0.5, y + 0.5});
      if (!toward) continue;
      looks_.push_back({*toward, elevation(*toward), pixel_solid_angle(camera, x, y).in(sr)});
    }
}

PartShares CameraSky::shares(const Direction<Enu>& sun, Angle horizon, Angle highest) const {
  PartShares shares{};
  double all = 0;
  for (const Look& look : looks_) {
    if (look.elevation > highest) continue;
    const auto part = part_of(look.toward, sun, horizon);
    if (!part) continue;
    shares[size_t(*part)] += look.solid_angle;
    all += look.solid_angle;
  }
  if (all > 0)
    for (double& share : shares) share /= all;
  return shares;
}

}  // namespace skylapse::plan
