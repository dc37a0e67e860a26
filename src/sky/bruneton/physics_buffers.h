#pragma once
// What shaders/shared/physics_host.glsl declares, filled: parameters and tables on a context.
#include <vector>

#include "gpu/buffer.h"
#include "gpu/shader_bundle.h"
#include "gpu/texture.h"
#include "sky/bruneton/columns.h"

namespace skylapse::sky::bruneton {

/// Groups of four bands that one shader treats together.
struct GroupRange {
  int first = 0, count = 1;
};
inline constexpr int kGroupsAtOnce = 4;
/// All groups of a medium, kGroupsAtOnce at a time.
std::vector<GroupRange> group_ranges(int groups);

/// Numbers as a shader sees them: each double becomes a float.
std::vector<float> floats_of(const double* values, size_t count);
/// Any struct of nothing but doubles.
template <class Block>
std::vector<float> floats_of_block(const Block& block) {
  static_assert(sizeof(Block) % sizeof(double) == 0);
  return floats_of(reinterpret_cast<const double*>(&block), sizeof(Block) / sizeof(double));
}
std::vector<float> floats_of(const std::vector<glm::dvec4>& values);

/// Most Gauss nodes of a march.
inline constexpr int kMaxGauss = 64;
/// How shaders interpolate in tables. Samplers of software are exact and quick; those of hardware
/// keep 8 bits of the weights.
enum class Filter { sampler, exact };
inline Filter filter_of(const gpu::ContextInfo& info) {
  return info.software ? Filter::sampler : Filter::exact;
}
/// The defines that physics_host.glsl needs. `layered`: whether the air has layers that no table
/// holds; software renderers run through the code of a loop even where it has no turns.
/// `scaled`: whether the source tables hold half floats.
std::vector<gpu::Define> physics_defines(int groups, int fold, Filter filter, bool layered,
                                         bool scaled = false);

/// Members run inside Context::run.
class PhysicsBuffers {
 public:
  PhysicsBuffers() = default;
  /// Parameters of a range of groups, a black ground, and no source textures.
  static Result<PhysicsBuffers> create(const gpu::Functions& gl, const PhysicsData& data,
                                       const Columns& columns, GroupRange range);
  void set_ground(const gpu::Functions& gl, const std::vector<float>& rows);
  /// One source texture a group, kept by the caller.
  void bind(const gpu::Functions& gl, const std::vector<gpu::Texture>& source) const;

 private:
  gpu::Buffer air_, bands_, gauss_, ground_;
  gpu::Texture columns_;
};

/// How many heights of a source texture stand side by side, so that no axis is longer than
/// `max_texture_3d`.
int fold_of(const Settings& settings, int max_texture_3d);
/// Size of one group's source texture.
gpu::TextureSize source_size(const Settings& settings, int fold);
/// One group of Tables::source, or of HalfSource, in that texture's order.
std::vector<float> folded_source(const std::vector<float>& source, const Settings& settings,
                                 int fold);
std::vector<std::uint16_t> folded_source(const std::vector<std::uint16_t>& source,
                                         const Settings& settings, int fold);

}  // namespace skylapse::sky::bruneton
