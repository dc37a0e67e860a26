#include "sky/sun_disc.h"

#include <algorithm>
#include <cmath>

#include "sky/sun_disc_lattice.h"

namespace skylapse::sky {
namespace {

/// A pixel's light with what is needed to turn it into radiance.
struct LitPixel {
  PixelLight light;
  double solid_angle;
  double sine;  // of the centre's elevation; 0 below the level
};

/// One entry per pixel, in reading order.
std::vector<LitPixel> merged(const image::Camera& camera, std::vector<PixelLight> light) {
  std::sort(light.begin(), light.end(), [](const PixelLight& a, const PixelLight& b) {
    return a.y != b.y ? a.y < b.y : a.x < b.x;
  });
  std::vector<LitPixel> pixels;
  for (const PixelLight& l : light) {
    if (!pixels.empty() && pixels.back().light.x == l.x && pixels.back().light.y == l.y) {
      pixels.back().light.flux += l.flux;
      pixels.back().light.weight += l.weight;
      continue;
    }
    const auto direction = image::direction_at(camera, {l.x + 0.5, l.y + 0.5});
    pixels.push_back({l, image::pixel_solid_angle(camera, l.x, l.y).in(sr),
                      direction ? std::max(0.0, direction->z()) : 0});
  }
  return pixels;
}

/// What the picture should hold of the reference energy: the lattice tells which part of the disc
/// is seen, the reference how much there is.
DiscEnergy target_energy(const DiscEnergy& reference, const LatticeSums& sums) {
  DiscEnergy target{sums.seen.flux, sums.seen.horizontal};
  if (!sums.complete || sums.whole.weight == 0) return target;
  const double part = sums.seen.weight / sums.whole.weight;
  target.normal_irradiance += part * (reference.normal_irradiance - sums.whole.flux);
  target.horizontal_irradiance += part * (reference.horizontal_irradiance - sums.whole.horizontal);
  return target;
}

/// Sets the flux: the small remainder is shared out by solid angle, which is safe for channels of
/// any sign, as a factor would not be.
void set_flux(std::vector<LitPixel>& pixels, const glm::dvec3& target) {
  glm::dvec3 flux{0};
  double weight = 0;
  for (const LitPixel& p : pixels) {
    flux += p.light.flux;
    weight += p.light.weight;
  }
  if (weight == 0) return;
  const glm::dvec3 missing = (target - flux) / weight;
  for (LitPixel& p : pixels) p.light.flux += p.light.weight * missing;
}

/// Sets the ground's irradiance by a slight tilt of the light towards higher or lower pixels,
/// which leaves the flux alone. The tilt is at most half of the mean light per pixel (`pixel_rad`)
/// of elevation: a disc within one or two rows cannot have both sums, and neither along a row that
/// bends a little nor at the zenith, where all pixels are equally high, is it worth any more.
void set_horizontal(std::vector<LitPixel>& pixels, const glm::dvec3& target, double pixel_rad) {
  glm::dvec3 flux{0}, horizontal{0};
  double weight = 0, weighted_sine = 0;
  for (const LitPixel& p : pixels) {
    flux += p.light.flux;
    horizontal += p.light.flux * p.sine;
    weight += p.light.weight;
    weighted_sine += p.light.weight * p.sine;
  }
  if (weight == 0) return;
  const double mean_sine = weighted_sine / weight;
  double variance = 0;
  for (const LitPixel& p : pixels) {
    const double offset = p.sine - mean_sine;
    variance += p.light.weight * offset * offset;
  }
  // Of pixels at one elevation the offsets are rounding: a tilt would be a change of flux.
  constexpr double kSameElevation = 1e-9, kMostTilt = 0.5;
  const double spread = std::sqrt(variance / weight);
  if (spread < kSameElevation) return;
  // No pixel lies farther off than about 2 spreads and a pixel, so none is pushed below zero.
  const glm::dvec3 limit = kMostTilt * glm::abs(flux) / weight / (2 * spread + pixel_rad);
  const glm::dvec3 tilt = glm::clamp((target - horizontal) / variance, -limit, limit);
  for (LitPixel& p : pixels) p.light.flux += tilt * (p.light.weight * (p.sine - mean_sine));
}

ProjectedDisc to_radiance(const std::vector<LitPixel>& pixels) {
  ProjectedDisc projected;
  projected.pixels.reserve(pixels.size());
  for (const LitPixel& p : pixels) {
    projected.pixels.push_back({p.light.x, p.light.y, p.light.flux / p.solid_angle});
    projected.energy.normal_irradiance += p.light.flux;
    projected.energy.horizontal_irradiance += p.light.flux * p.sine;
  }
  return projected;
}

}  // namespace

ProjectedDisc project_sun_disc(const image::Camera& camera, const SunDisc& disc) {
  assert(disc.radius > Angle{} && disc.radius <= 10 * deg);
  const Angle el = elevation(disc.centre) - disc.horizon;
  if (el <= -disc.flattening * disc.radius) return {};
  const LatticePlan plan = plan_lattice(camera, disc);
  const Angle reach = disc.radius + 3 * plan.pixel_extent_rad * rad;
  const std::optional<Angle> near_horizon = el < reach ? std::optional(disc.horizon) : std::nullopt;
  LatticeSums sums;
  std::vector<PixelLight> light;
  for (const image::Chart& chart : image::charts(camera)) {
    SplatPlane plane(chart, plan.tent, near_horizon);
    splat_chart(chart, disc, plan, plane, sums);
    plane.collect(light);
  }
  if (light.empty()) return {};
  const DiscEnergy target = target_energy(disc_energy(disc), sums);
  auto pixels = merged(camera, std::move(light));
  set_flux(pixels, target.normal_irradiance);
  set_horizontal(pixels, target.horizontal_irradiance, plan.pixel_extent_rad);
  return to_radiance(pixels);
}

void add_rows(const ProjectedDisc& projected, int first_row, image::FrameBuffer& image) {
  for (const PixelAddition& a : projected.pixels) {
    const int row = a.y - first_row;
    if (row < 0 || row >= image.height()) continue;
    float* p = image.pixel(a.x, row);
    for (int c = 0; c < 3; ++c) p[c] += static_cast<float>(a.radiance[c]);
  }
}

DiscEnergy add_sun_disc(const image::Camera& camera, const SunDisc& disc,
                        image::FrameBuffer& image) {
  assert(camera.width == image.width() && camera.height == image.height());
  const ProjectedDisc projected = project_sun_disc(camera, disc);
  add_rows(projected, 0, image);
  return projected.energy;
}

void add_sun_disc_rows(const image::Camera& camera, const SunDisc& disc, int first_row,
                       image::FrameBuffer& image) {
  assert(camera.width == image.width());
  assert(first_row >= 0 && first_row + image.height() <= camera.height);
  add_rows(project_sun_disc(camera, disc), first_row, image);
}

}  // namespace skylapse::sky
