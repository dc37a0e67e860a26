#include "image/lighting/irradiance_map.h"

#include <algorithm>
#include <cassert>
#include <numbers>
#include <vector>

#include "core/parallel.h"
#include "image/lighting/cube_mips.h"
#include "image/lighting/sources.h"
#include "image/lighting/zonal_kernel.h"

namespace skylapse::image {
namespace {

using kernel::Source;
using kernel::WideBlock;

constexpr int kBatch = 512;  // sources whose sum is kept in float

struct Sums {
  double weight = 0;
  glm::dvec3 light{0};
};

/// One block of pixels in reading order, from `first`.
void fill_block(const Camera& camera, const SphereSources& sky, std::span<const PointLight> lights,
                size_t first, size_t count, FrameBuffer& out) {
  WideBlock block{};
  std::array<std::optional<Direction<Enu>>, WideBlock::kCount> normals;
  for (size_t i = 0; i < count; ++i) {
    const size_t pixel = first + i;
    normals[i] = direction_at(camera, {double(pixel % size_t(camera.width)) + 0.5,
                                       double(pixel / size_t(camera.width)) + 0.5});
    const glm::vec3 n(normals[i] ? normals[i]->vec() : glm::dvec3(0, 0, 1));
    block.x[i] = n.x, block.y[i] = n.y, block.z[i] = n.z;
  }
  std::array<Sums, WideBlock::kCount> sums{};
  for (size_t k = 0; k < sky.pieces.size(); k += kBatch) {
    kernel::sum_cosine(&sky.pieces[k], int(std::min<size_t>(kBatch, sky.pieces.size() - k)), block);
    for (size_t i = 0; i < count; ++i) {
      sums[i].weight += block.weight[i];
      sums[i].light += glm::dvec3(block.r[i], block.g[i], block.b[i]);
    }
  }
  for (size_t i = 0; i < count; ++i) {
    if (!normals[i]) continue;
    glm::dvec3 e = std::numbers::pi * (sky.reference + sums[i].light / sums[i].weight);
    for (const PointLight& light : lights)
      e += std::max(0.0, glm::dot(normals[i]->vec(), light.direction.vec())) * light.irradiance;
    for (int c = 0; c < 3; ++c) out.data()[3 * (first + i) + size_t(c)] = float(e[c]);
  }
}

}  // namespace

int irradiance_source_side(size_t pixels) { return pixels <= size_t{6} * 64 * 64 ? 64 : 32; }

FrameBuffer irradiance_map(const Camera& camera, const Camera& sky_camera, const FrameBuffer& sky,
                           std::span<const PointLight> lights) {
  FrameBuffer out(camera.width, camera.height);
  const int side = std::min(sky.width(), irradiance_source_side(out.pixel_count()));
  const SphereSources sources = sources_of(sky_camera, shrunk_cube(sky, side));
  const size_t blocks = (out.pixel_count() + WideBlock::kCount - 1) / WideBlock::kCount;
  parallel_for_ranges(blocks, 1, [&](size_t begin, size_t end) {
    for (size_t b = begin; b < end; ++b) {
      const size_t first = b * WideBlock::kCount;
      fill_block(camera, sources, lights, first,
                 std::min<size_t>(WideBlock::kCount, out.pixel_count() - first), out);
    }
  });
  return out;
}

}  // namespace skylapse::image
