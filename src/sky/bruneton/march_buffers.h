#pragma once
// March lists and matrices of the precomputation as buffers: what shaders/shared/march_list.glsl
// and the gather shaders read.
#include "gpu/buffer.h"
#include "sky/bruneton/march_lists.h"
#include "sky/bruneton/physics_buffers.h"

namespace skylapse::sky::bruneton {

/// One list, for a range of groups. With `split` the weights of both components stay apart (order
/// 1 needs their phase functions), else `rayleigh` holds their sum.
struct MarchBuffers {
  gpu::Buffer rays, samples, to_ground, rayleigh, aerosol;

  static MarchBuffers create(const gpu::Functions& gl, const MarchLists& lists,
                             const Settings& settings, GroupRange range, bool split);
  void bind(const gpu::Functions& gl) const;
};

/// The matrices between directions, harmonics and table nodes; free of bands but for the moments.
struct HarmonicBuffers {
  gpu::Buffer direction_cosines, analysis, moments, synthesis, table_cosines, ground_weights;

  static HarmonicBuffers create(const gpu::Functions& gl, const atmosphere::Medium& medium,
                                const std::vector<DirectionRows>& rows, const Settings& settings,
                                GroupRange range);
};

}  // namespace skylapse::sky::bruneton
