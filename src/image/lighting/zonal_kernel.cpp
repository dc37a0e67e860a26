// Compiled with -O3 -fno-math-errno -fno-trapping-math, as sky/hosek_wilkie/sky_kernel.cpp.
#include "image/lighting/zonal_kernel.h"

#include "core/vector_kernel.h"

namespace skylapse::image::kernel {
namespace {

template <class Block>
SKYLAPSE_INLINE void clear(Block& block) {
  for (int i = 0; i < Block::kCount; ++i)
    block.weight[i] = block.r[i] = block.g[i] = block.b[i] = 0.0f;
}

template <class Block>
SKYLAPSE_INLINE void add(Block& block, int i, const Source& s, float weight) {
  block.weight[i] += weight;
  block.r[i] += weight * s.r;
  block.g[i] += weight * s.g;
  block.b[i] += weight * s.b;
}

}  // namespace

SKYLAPSE_CLONES
void sum_cosine(const Source* sources, int count, WideBlock& block) {
  clear(block);
  for (int k = 0; k < count; ++k) {
    const Source s = sources[k];
    for (int i = 0; i < WideBlock::kCount; ++i) {
      const float c = s.x * block.x[i] + s.y * block.y[i] + s.z * block.z[i];
      add(block, i, s, s.sr * (c > 0.0f ? c : 0.0f));
    }
  }
}

SKYLAPSE_CLONES
void sum_ggx(const Source* sources, int count, float a2, Tile& tile) {
  clear(tile);
  const float bend = 0.25f * (1.0f - a2);
  for (int k = 0; k < count; ++k) {
    const Source s = sources[k];
    for (int i = 0; i < Tile::kCount; ++i) {
      const float dx = s.x - tile.x[i], dy = s.y - tile.y[i], dz = s.z - tile.z[i];
      // |d|^2 = 2 (1 - c), without cancelling where the peak is.
      const float chord2 = dx * dx + dy * dy + dz * dz;
      const float c = 1.0f - 0.5f * chord2;
      const float shape = a2 + bend * chord2;
      add(tile, i, s, s.sr * (c > 0.0f ? c : 0.0f) / (shape * shape));
    }
  }
}

}  // namespace skylapse::image::kernel
