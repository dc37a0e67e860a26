#include "sky/level_light.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "image/irradiance.h"

namespace skylapse::sky {
namespace {

struct Place {
  int x = 0, y = 0;
};

/// A pixel that stands on the level plane and the one that hangs below it.
struct Pair {
  Place above, below;
  double sine = 0;  // of the upper one's centre
  double solid_angle = 0, solid_angle_below = 0;
};

/// Nothing if the pixel is not beside the plane, or its mirror image not below it in the picture.
std::optional<Pair> pair_of(const image::Camera& camera, Place at) {
  constexpr double kSides = 1.25;  // the centre of the row after is 1.5 sides high
  const auto direction = image::direction_at(camera, {at.x + 0.5, at.y + 0.5});
  if (!direction || direction->z() <= 0) return {};
  const double solid_angle = image::pixel_solid_angle(camera, at.x, at.y).in(sr);
  if (direction->z() > kSides * std::sqrt(solid_angle)) return {};
  const glm::dvec3 mirrored(direction->x(), direction->y(), -direction->z());
  const auto position = image::position_of(camera, Direction<Enu>::from_vector(mirrored));
  if (!position) return {};
  const Place below{std::clamp(int(std::floor(position->x)), 0, camera.width - 1),
                    std::clamp(int(std::floor(position->y)), 0, camera.height - 1)};
  const auto centre = image::direction_at(camera, {below.x + 0.5, below.y + 0.5});
  const double there = image::pixel_solid_angle(camera, below.x, below.y).in(sr);
  if (!centre || centre->z() > 0 || there == 0) return {};
  return Pair{at, below, direction->z(), solid_angle, there};
}

/// The share of the light of the pairs, whose irradiance is `beside`, that has to sink.
glm::dvec3 sinking_share(const glm::dvec3& excess, const glm::dvec3& beside) {
  glm::dvec3 share{0};
  for (int c = 0; c < 3; ++c)
    if (excess[c] > 0 && beside[c] > 0) share[c] = std::min(1.0, excess[c] / beside[c]);
  return share;
}

}  // namespace

void sink_to_level(const image::Camera& camera, const glm::dvec3& most, ProjectedDisc& disc) {
  const glm::dvec3 excess = disc.energy.horizontal_irradiance - most;
  if (std::max({excess.x, excess.y, excess.z}) <= 0) return;
  std::map<std::pair<int, int>, glm::dvec3> radiance;  // by row and column
  std::vector<Pair> pairs;
  glm::dvec3 beside{0};
  for (const PixelAddition& p : disc.pixels) {
    radiance[{p.y, p.x}] = p.radiance;
    if (const auto pair = pair_of(camera, {p.x, p.y})) {
      pairs.push_back(*pair);
      beside += p.radiance * pair->solid_angle * pair->sine;
    }
  }
  const glm::dvec3 share = sinking_share(excess, beside);
  for (const Pair& pair : pairs) {
    glm::dvec3& above = radiance[{pair.above.y, pair.above.x}];
    const glm::dvec3 sinks = above * share;
    above -= sinks;
    radiance[{pair.below.y, pair.below.x}] += sinks * (pair.solid_angle / pair.solid_angle_below);
  }
  disc.energy.horizontal_irradiance -= share * beside;
  disc.pixels.clear();
  for (const auto& [place, value] : radiance)
    disc.pixels.push_back({place.second, place.first, value});
}

void sink_to_level(const image::Camera& camera, const glm::dvec3& most, image::FrameBuffer& image) {
  const glm::dvec3 excess = image::image_irradiance(camera, image) - most;
  if (std::max({excess.x, excess.y, excess.z}) <= 0) return;
  const auto value = [&](Place at) { return image.pixel(at.x, at.y); };
  std::vector<Pair> pairs;
  glm::dvec3 beside{0};
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const auto pair = pair_of(camera, {x, y});
      if (!pair) continue;
      pairs.push_back(*pair);
      const float* const p = value(pair->above);
      beside += glm::dvec3(p[0], p[1], p[2]) * pair->solid_angle * pair->sine;
    }
  const glm::dvec3 share = sinking_share(excess, beside);
  for (const Pair& pair : pairs)
    for (int c = 0; c < 3; ++c) {
      const double sinks = value(pair.above)[c] * share[c];
      value(pair.above)[c] -= float(sinks);
      value(pair.below)[c] += float(sinks * pair.solid_angle / pair.solid_angle_below);
    }
}

}  // namespace skylapse::sky
