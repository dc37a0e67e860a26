#pragma once
// The loops that run once for each pair of a source of light and a texel that it lights, written
// for the vectoriser and compiled for several instruction sets.

namespace skylapse::image::kernel {

/// A piece of the sphere: unit vector to its middle, solid angle, and its mean radiance.
struct Source {
  float x, y, z, sr;
  float r, g, b, unused;
};

/// Texels that are worked on together: their unit vectors, and sums over sources of weight and of
/// weight times radiance.
template <int N>
struct Block {
  static constexpr int kCount = N;
  alignas(64) float x[N], y[N], z[N];
  alignas(64) float weight[N], r[N], g[N], b[N];
};
using WideBlock = Block<64>;
using Tile = Block<64>;

/// Sets the sums to weights of clamped cosines: sr max(0, c), with c the cosine of the angle.
void sum_cosine(const Source* sources, int count, WideBlock& block);

/// Sets the sums to weights of GGX: sr max(0, c) / (a2 + (1 - a2) (1 - c) / 2)^2. See specular.h.
void sum_ggx(const Source* sources, int count, float a2, Tile& tile);

}  // namespace skylapse::image::kernel
