#include "image/lighting/specular.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "image/camera/cube.h"
#include "image/lighting/cube_mips.h"
#include "image/lighting/sources.h"

namespace skylapse::image {
namespace {

constexpr double kPi = std::numbers::pi;

// A piece of the pyramid is fine enough if its middle is nearer to its corners than this share of
// the kernel's scale there, sqrt(distance^2 + (2 alpha)^2): the weights are then within 1 % of
// their means, with errors of either sign.
constexpr float kFineEnough = 0.1f;
// And never farther than this, for the sake of the cosine, which ends at 90 degrees.
constexpr float kFarthestCorner = 0.05f;
// Smaller cubes are filtered at this side or more and shrunk.
constexpr int kSmallestFiltered = 32;
constexpr int kTileSide = 8;
static_assert(kTileSide * kTileSide == kernel::Tile::kCount);

/// Integral of c / (a2 + (1 - a2)(1 - c) / 2)^2 over c from 0 to 1.
double kernel_integral(double a2) {
  const double b = 0.5 * (1 - a2);
  if (b < 1e-6) return 0.5 / (a2 * a2);
  const double end = a2 + b;
  return (1 / a2 - 1 / end) / b - (std::log(end / a2) + a2 / end - 1) / (b * b);
}

}  // namespace

double roughness_of_level(int level, int levels) {
  return levels > 1 ? double(level) / (levels - 1) : 0;
}

double alpha_of_roughness(double roughness) { return roughness * roughness; }

GgxKernel::GgxKernel(double alpha) : a2_(alpha * alpha) {
  assert(alpha > 0 && alpha <= 1);
  scale_ = 1 / (2 * kPi * kernel_integral(a2_));
}

SpecularSource::SpecularSource(const Camera& camera, const FrameBuffer& sky, double lowest_alpha)
    : camera_(camera) {
  // The middle of a pixel in the middle of a face is sqrt(2) / side from its corners.
  const double finest = std::numbers::sqrt2 / (kFineEnough * 2 * lowest_alpha);
  const auto wanted = unsigned(std::clamp(std::ceil(finest), 1.0, double(sky.width())));
  const unsigned side = std::min(std::bit_ceil(wanted), std::bit_floor(unsigned(sky.width())));
  FrameBuffer strip = shrunk_cube(sky, int(side));
  flux_ = flux_of(sky);
  for (;;) {
    const int side = strip.width();
    SphereSources sources = sources_of(camera, strip);
    if (levels_.empty()) reference_ = sources.reference;
    const glm::vec3 shift(sources.reference - reference_);
    std::vector<Node> nodes(sources.pieces.size());
    parallel_for_ranges(nodes.size(), 4096, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        kernel::Source light = sources.pieces[i];
        light.r += shift.x, light.g += shift.y, light.b += shift.z;
        // On a plane at distance 1 the corners are sqrt(2) / side away, and chords are shorter by
        // the cosine to its axis, whose cube is the solid angle per area.
        const float cosine = std::cbrt(light.sr * float(side) * float(side) / 4);
        nodes[i] = {light, std::numbers::sqrt2_v<float> / float(side) * cosine};
      }
    });
    levels_.push_back(std::move(nodes));
    if (side == 1) break;
    strip = shrunk_cube(strip, side / 2);
  }
}

/// Pieces for a tile whose texels lie within `reach` of its middle.
void SpecularSource::gather(const glm::vec3& middle, float reach, float alpha,
                            std::vector<Node>& out) const {
  struct Place {
    int level, face, x, y;
  };
  std::vector<Place> open;
  for (int face = 0; face < 6; ++face) open.push_back({int(levels_.size()) - 1, face, 0, 0});
  out.clear();
  while (!open.empty()) {
    const Place p = open.back();
    open.pop_back();
    const int side = 1 << (int(levels_.size()) - 1 - p.level);
    const Node& node = levels_[size_t(p.level)][size_t((p.face * side + p.y) * side + p.x)];
    const glm::vec3 d = glm::vec3(node.light.x, node.light.y, node.light.z) - middle;
    const float chord = glm::length(d);
    // Wholly beyond 90 degrees of all texels: chords of sqrt 2.
    if (chord - reach - node.reach > std::numbers::sqrt2_v<float>) continue;
    const float nearest = std::max(0.0f, chord - reach);
    const float scale = std::sqrt(nearest * nearest + 4 * alpha * alpha);
    if (p.level == 0 || node.reach <= std::min(kFarthestCorner, kFineEnough * scale)) {
      out.push_back(node);
      continue;
    }
    for (int k = 0; k < 4; ++k)
      open.push_back({p.level - 1, p.face, 2 * p.x + k % 2, 2 * p.y + k / 2});
  }
}

void SpecularSource::fill_tile(int side, int face, int x0, int y0, double alpha,
                               FrameBuffer& out) const {
  const Camera view = strip_camera(camera_, side);
  kernel::Tile tile{};
  std::array<glm::vec3, kernel::Tile::kCount> normals;
  glm::vec3 middle{0};
  for (int i = 0; i < kernel::Tile::kCount; ++i) {
    // Beyond the face's edge the last texel is done again.
    const int x = std::min(x0 + i % kTileSide, side - 1);
    const int y = face * side + std::min(y0 + i / kTileSide, side - 1);
    const glm::vec3 n(direction_at(view, {x + 0.5, y + 0.5})->vec());
    normals[size_t(i)] = n;
    tile.x[i] = n.x, tile.y[i] = n.y, tile.z[i] = n.z;
    middle += n;
  }
  middle = glm::normalize(middle);
  float reach = 0;
  for (const glm::vec3& n : normals) reach = std::max(reach, glm::length(n - middle));
  std::vector<Node> nodes;
  gather(middle, reach, float(alpha), nodes);
  std::vector<kernel::Source> sources;
  sources.reserve(nodes.size());
  for (const Node& node : nodes) sources.push_back(node.light);
  kernel::sum_ggx(sources.data(), int(sources.size()), float(alpha * alpha), tile);
  for (int i = 0; i < kernel::Tile::kCount; ++i) {
    const int x = x0 + i % kTileSide, y = y0 + i / kTileSide;
    if (x >= side || y >= side) continue;
    const glm::dvec3 mean =
        reference_ + glm::dvec3(tile.r[i], tile.g[i], tile.b[i]) / double(tile.weight[i]);
    for (int c = 0; c < 3; ++c) out.pixel(x, face * side + y)[c] = float(mean[c]);
  }
}

FrameBuffer SpecularSource::filtered(int side, double alpha) const {
  assert(side >= 1 && alpha > 0 && alpha <= 1);
  const int fine = side * std::max(1, (kSmallestFiltered + side - 1) / side);
  FrameBuffer out(fine, 6 * fine);
  const int tiles = (fine + kTileSide - 1) / kTileSide;
  parallel_for_ranges(size_t(6) * size_t(tiles) * size_t(tiles), 4, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const int tile = int(i % size_t(tiles * tiles)), face = int(i / size_t(tiles * tiles));
      fill_tile(fine, face, kTileSide * (tile % tiles), kTileSide * (tile / tiles), alpha, out);
    }
  });
  const glm::dvec3 flux = flux_of(out);
  for (size_t i = 0; i < out.data().size(); ++i)
    if (flux[int(i % 3)] > 0)
      out.data()[i] = float(out.data()[i] * (flux_[int(i % 3)] / flux[int(i % 3)]));
  return fine == side ? out : shrunk_cube(out, side);
}

}  // namespace skylapse::image
