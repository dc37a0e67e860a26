#include "sky/sun_disc_lattice.h"

#include <algorithm>
#include <cmath>

namespace skylapse::sky {
namespace {

// Cells per radius of the disc: the coverage of the whole is then right to about 1e-3 before it is
// set to the reference, and a part cut off by the frame to 0.5 %.
constexpr double kCellsPerRadius = 16;
// From 32 pixels per radius on, whole pixels do: the place of the edge within them is 0.1 % of the
// disc. Tent and half pixels fade out from 16 pixels on, so that nothing jumps.
constexpr double kPixelsWithTent = 16, kPixelsWithoutTent = 32;
// Limit where the pixels' sides are very unequal (the rim of a 360 degree fisheye): such pixels
// are cut no finer than this allows, but at least in two.
constexpr double kMostPackets = 1e5;

/// Cuts of a pixel that spans `extent`, for a disc of radius `r`.
int cuts(double extent, double r) {
  if (r >= kPixelsWithoutTent * extent) return 1;
  return std::max(2, static_cast<int>(std::ceil(kCellsPerRadius * extent / r)));
}

/// One cell's share of the disc, with soft edges one cell wide at the limb and at the horizon.
class DiscSampler {
 public:
  explicit DiscSampler(const SunDisc& disc)
      : disc_(disc),
        radius_(disc.radius.in(rad)),
        sine_radius_(sin(disc.radius)),
        horizon_(disc.horizon.in(rad)) {}

  struct Sample {
    double weight = 0;  // covered solid angle
    double above = 0;   // share of the cell above the horizon
    glm::dvec3 flux{0};
    double sine = 0;  // of the elevation of the covered part's middle; 0 below the level
  };

  /// From the centre, before flattening.
  [[nodiscard]] double angle_in_disc(const Direction<Enu>& direction) const {
    const double chord = glm::length(direction.vec() - disc_.centre.vec());
    // Flattening draws points together: what is outside the round disc is outside.
    if (disc_.flattening == 1 || chord > 2 * radius_)
      return 2 * std::asin(std::min(1.0, 0.5 * chord));
    return 2 * std::asin(std::sqrt(std::min(1.0, haversine_in_disc(disc_, direction))));
  }

  [[nodiscard]] Sample operator()(const Direction<Enu>& direction, SolidAngle cell) const {
    const double side = std::sqrt(cell.in(sr));
    const double gamma = angle_in_disc(direction);
    const double in_disc = std::clamp((radius_ - gamma) / side + 0.5, 0.0, 1.0);
    if (in_disc == 0 || side == 0) return {};
    const double el = elevation(direction).in(rad);
    const double above = image::horizon_coverage(el * rad, cell, disc_.horizon);
    if (above == 0) return {};
    const double middle_el = above < 1 ? 0.5 * (el + horizon_ + 0.5 * side) : el;
    const double inner = std::max(0.0, gamma - 0.5 * side);
    const double middle_gamma = in_disc < 1 ? 0.5 * (inner + radius_) : gamma;
    const double q = std::sin(std::min(middle_gamma, radius_)) / sine_radius_;
    const double limb = std::sqrt(std::max(0.0, 1 - q * q));
    const double weight = cell.in(sr)*in_disc * above;
    return {weight, above, weight * disc_.radiance(middle_el * rad, limb),
            std::max(0.0, std::sin(middle_el))};
  }

 private:
  const SunDisc& disc_;
  double radius_;
  double sine_radius_;
  double horizon_;
};

void count(PacketSums& sums, const DiscSampler::Sample& sample, double part) {
  sums.flux += part * sample.flux;
  sums.horizontal += part * sample.sine * sample.flux;
  sums.weight += part * sample.weight;
}

}  // namespace

LatticePlan plan_lattice(const image::Camera& camera, const SunDisc& disc) {
  const auto centre = image::to_camera_frame(camera, disc.centre);
  const auto extent = image::pixel_extent(camera, centre, disc.radius);
  const double r = disc.radius.in(rad), x = extent.x.in(rad), y = extent.y.in(rad);
  LatticePlan plan;
  plan.grid = {cuts(x, r), cuts(y, r)};
  const double pixels = std::numbers::pi * r * r / extent.area.in(sr);
  const int most = std::max(2, static_cast<int>(std::sqrt(kMostPackets / pixels)));
  plan.grid.columns = std::min(plan.grid.columns, most);
  plan.grid.rows = std::min(plan.grid.rows, most);
  const double radius_px = r / std::max(x, y);
  plan.tent = std::clamp((kPixelsWithoutTent - radius_px) / (kPixelsWithoutTent - kPixelsWithTent),
                         0.0, 1.0);
  plan.pixel_extent_rad = std::max(x, y);
  plan.cell_extent_rad = std::max(x / plan.grid.columns, y / plan.grid.rows);
  return plan;
}

void splat_chart(const image::Chart& chart, const SunDisc& disc, const LatticePlan& plan,
                 SplatPlane& plane, LatticeSums& sums) {
  const DiscSampler sample_disc(disc);
  const auto [columns, rows] = plan.grid;
  const double pixels_per_cell = 1.0 / (double(columns) * rows);
  const auto centre = image::to_camera_frame(chart.camera, disc.centre);
  const Angle reach = disc.radius + 1.5 * plan.cell_extent_rad * rad;
  const auto footprint = image::footprint(chart, centre, reach, plan.grid);
  sums.complete = sums.complete && footprint.complete;
  for (const auto& span : footprint.spans)
    for (int64_t i = span.begin; i < span.end; ++i) {
      const image::PixelPosition p{(double(i) + 0.5) / columns, (double(span.row) + 0.5) / rows};
      const auto at = image::chart_sample(chart, p);
      if (!at) continue;
      const SolidAngle cell = at->sr_per_pixel * pixels_per_cell * sr;
      const auto sample = sample_disc(image::to_enu(chart.camera, at->direction), cell);
      if (sample.weight == 0) continue;
      count(sums.whole, sample, 1);
      // Where the rim of the picture is the horizon, the cell is cut once, not twice.
      const double share = image::share_in_picture(chart, p, *at, cell);
      const double part = std::min(1.0, share / sample.above);
      if (part == 0) continue;
      count(sums.seen, sample, part);
      plane.add({p, part * sample.flux, part * sample.weight});
    }
}

}  // namespace skylapse::sky
