#include "plan/sky_parts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace skylapse::plan {
namespace {

/// Rows and columns of looks: the shares are good to some percent, which is what bounds are.
constexpr int kCoarse = 20;
/// Where fewer than kFewLooks of those fall into the sky. From 400 km the air is a ring of 3 deg.
constexpr int kFine = 240, kFewLooks = 20;

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

CameraSky::Looks CameraSky::looks_of(const image::Camera& camera, int cells) {
  // A cell stands for its pixels: the solid angle of the middle one times their number.
  const int across = std::min(camera.width, cells), down = std::min(camera.height, cells);
  Looks looks;
  for (int row = 0; row < down; ++row)
    for (int column = 0; column < across; ++column) {
      const int x = int((2 * column + 1) * long(camera.width) / (2 * across));
      const int y = int((2 * row + 1) * long(camera.height) / (2 * down));
      const auto toward = image::direction_at(camera, {x + 0.5, y + 0.5});
      if (!toward) continue;
      looks.push_back({*toward, elevation(*toward), pixel_solid_angle(camera, x, y).in(sr)});
    }
  return looks;
}

CameraSky::CameraSky(const image::Camera& camera)
    : coarse_(looks_of(camera, kCoarse)), fine_(looks_of(camera, kFine)) {}

PartShares CameraSky::shares(const Direction<Enu>& sun, Angle horizon, Angle highest) const {
  const auto sum = [&](const Looks& looks, PartShares& shares) {
    int found = 0;
    for (const Look& look : looks) {
      if (look.elevation > highest) continue;
      const auto part = part_of(look.toward, sun, horizon);
      if (!part) continue;
      shares[size_t(*part)] += look.solid_angle;
      ++found;
    }
    return found;
  };
  PartShares shares{};
  if (sum(coarse_, shares) < kFewLooks) {
    shares = {};
    sum(fine_, shares);
  }
  const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
  if (all > 0)
    for (double& share : shares) share /= all;
  return shares;
}

}  // namespace skylapse::plan
