#include "sky/bruneton/physics_buffers.h"

#include <algorithm>
#include <cassert>

#include "gpu/functions.h"
#include "gpu/program.h"

namespace skylapse::sky::bruneton {

std::vector<GroupRange> group_ranges(int groups) {
  std::vector<GroupRange> ranges;
  for (int first = 0; first < groups; first += kGroupsAtOnce)
    ranges.push_back({first, std::min(kGroupsAtOnce, groups - first)});
  return ranges;
}

std::vector<float> floats_of(const double* values, size_t count) {
  std::vector<float> result(count);
  std::transform(values, values + count, result.begin(), [](double v) { return float(v); });
  return result;
}

std::vector<float> floats_of(const std::vector<glm::dvec4>& values) {
  static_assert(sizeof(glm::dvec4) == 4 * sizeof(double));
  return values.empty() ? std::vector<float>{} : floats_of(&values[0][0], 4 * values.size());
}

std::vector<gpu::Define> physics_defines(int groups, int fold, Filter filter, bool layered,
                                         bool scaled) {
  return {{"GROUPS", groups},
          {"MAX_GAUSS", kMaxGauss},
          {"FOLD", fold},
          {"LAYERED", layered ? 1 : 0},
          {"SCALED_SOURCE", scaled ? 1 : 0},
          {"EXACT_FILTER", filter == Filter::exact ? 1 : 0}};
}

Result<PhysicsBuffers> PhysicsBuffers::create(const gpu::Functions& gl, const PhysicsData& data,
                                              const Columns& columns, GroupRange range) {
  PhysicsBuffers buffers;
  buffers.air_ = gpu::Buffer::of(gl, floats_of_block(data.air));
  std::vector<float> bands;
  for (int g = range.first; g < range.first + range.count; ++g) {
    const std::vector<float> group = floats_of_block(data.groups[g]);
    bands.insert(bands.end(), group.begin(), group.end());
  }
  buffers.bands_ = gpu::Buffer::of(gl, bands);
  assert(data.gauss.size() <= kMaxGauss);
  std::vector<glm::vec4> gauss(kMaxGauss, glm::vec4(0));
  for (size_t i = 0; i < data.gauss.size(); ++i) gauss[i] = glm::vec4(data.gauss[i], 0, 0);
  buffers.gauss_ = gpu::Buffer::of(gl, gauss);
  const size_t rows = size_t(data.air.sun_row_last) + 1;
  buffers.set_ground(gl, std::vector<float>(4 * rows * range.count, 0.0f));

  std::vector<glm::vec4> nodes;
  for (const glm::dvec3& column : columns.nodes()) nodes.emplace_back(column, 0);
  const int heights = int(data.air.columns_height_last) + 1;
  const int distances = int(data.air.columns_distance_last) + 1;
  assert(nodes.size() == size_t(heights) * distances);
  auto texture = gpu::Texture::create(gl, {distances, heights}, &nodes[0][0]);
  if (!texture) return texture.error();
  buffers.columns_ = std::move(texture).value();
  return buffers;
}

void PhysicsBuffers::set_ground(const gpu::Functions& gl, const std::vector<float>& rows) {
  ground_ = gpu::Buffer::of(gl, rows);
}

void PhysicsBuffers::bind(const gpu::Functions& gl, const std::vector<gpu::Texture>& source) const {
  air_.bind_uniform(gl, 0);
  bands_.bind_uniform(gl, 1);
  gauss_.bind_uniform(gl, 2);
  ground_.bind_storage(gl, 0);
  columns_.bind(gl, 0);
  for (size_t g = 0; g < source.size(); ++g) source[g].bind(gl, unsigned(1 + g));
}

int fold_of(const Settings& settings, int max_texture_3d) {
  int fold = 1;
  while (fold < settings.heights &&
         settings.table_zeniths * gpu::groups_for(settings.heights, fold) > max_texture_3d)
    ++fold;
  return fold;
}

gpu::TextureSize source_size(const Settings& settings, int fold) {
  return {settings.table_azimuths * fold, settings.sun_rows(),
          settings.table_zeniths * gpu::groups_for(settings.heights, fold)};
}

namespace {

template <class Number>
std::vector<Number> folded(const std::vector<Number>& source, const Settings& settings, int fold) {
  if (fold == 1) return source;
  const size_t row = size_t(4) * settings.table_azimuths, rows = settings.sun_rows();
  const size_t slabs = settings.table_zeniths;
  std::vector<Number> result(4 * source_size(settings, fold).texels(), Number(0));
  for (size_t h = 0; h < size_t(settings.heights); ++h)
    for (size_t z = 0; z < slabs; ++z)
      for (size_t j = 0; j < rows; ++j)
        std::copy_n(&source[((h * slabs + z) * rows + j) * row], row,
                    &result[(((h / fold * slabs + z) * rows + j) * fold + h % fold) * row]);
  return result;
}

}  // namespace

std::vector<float> folded_source(const std::vector<float>& source, const Settings& settings,
                                 int fold) {
  return folded(source, settings, fold);
}

std::vector<std::uint16_t> folded_source(const std::vector<std::uint16_t>& source,
                                         const Settings& settings, int fold) {
  return folded(source, settings, fold);
}

}  // namespace skylapse::sky::bruneton
