#include "sky/bruneton/gpu_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <list>

#include "core/parallel.h"
#include "gpu/functions.h"
#include "gpu/program.h"
#include "sky/bruneton/half_source.h"
#include "sky/bruneton/physics_buffers.h"
#include "sky/bruneton/rays.h"
#include "sky/bruneton/slice_lists.h"
#include "sky/bruneton/twin.h"

namespace skylapse::sky::bruneton {
namespace {

constexpr int kGroupSize = 32;              // local_size_x of both shaders
constexpr size_t kSliceBuffersKept = 4;     // some MB each
constexpr size_t kQueriesAtOnce = 1 << 15;  // bounds the memory of long lists

// As in shaders/entry/slice.comp and answer.comp (std140).
struct SliceBlock {
  float mu_s;
  int azimuths;
  int first_azimuth, end_azimuth, first_row;
  int multiple_scattering, ground, aerial_perspective;
};
struct AnswerBlock {
  int multiple_scattering, ground;
  int unused[2];
};
static_assert(sizeof(SliceBlock) == 32 && sizeof(AnswerBlock) == 16, "the layout of std140");

/// QueryRays of answer.comp, in double.
struct QueryRays {
  text::Ray view, to_sun;
  double mu_s, nu, sun_visible, unused;
};

std::vector<float> xyz_weights(const atmosphere::Medium& medium, GroupRange range) {
  std::vector<float> weights;
  for (size_t band = 4 * size_t(range.first); band < 4 * size_t(range.first + range.count); ++band)
    for (int c = 0; c < 4; ++c) {
      const bool spare = band >= medium.bands.size() || c == 3;
      weights.push_back(spare ? 0.0f : float(medium.bands[band].xyz_weight[c]));
    }
  return weights;
}

/// What the shaders need for one range of groups.
struct Range {
  GroupRange groups;
  PhysicsBuffers physics;
  std::vector<gpu::Texture> source;
  gpu::Buffer xyz_weight;
  gpu::Program slice, answer;
};

/// The source tables of a range of groups; of half floats, with their scales put into `data`.
Status upload_source(const gpu::Functions& gl, const Tables& tables, bool half, int fold,
                     Range& range, PhysicsData& data) {
  for (int g = range.groups.first; g < range.groups.first + range.groups.count; ++g) {
    const auto texture = [&] {
      const gpu::TextureSize size = source_size(tables.settings, fold);
      if (tables.source.empty()) return gpu::Texture::create(gl, {1, 1, 1}, &glm::vec4(0)[0]);
      if (!half)
        return gpu::Texture::create(gl, size,
                                    folded_source(tables.source[g], tables.settings, fold).data());
      const HalfSource source = half_source(tables.source[g]);
      data.groups[g].source_scale = source.scale;
      return gpu::Texture::create_half(gl, size,
                                       folded_source(source.halves, tables.settings, fold).data());
    };
    auto made = texture();
    if (!made) return made.error();
    range.source.push_back(std::move(made).value());
  }
  return Done{};
}

Result<Range> create_range(const gpu::Functions& gl, const Tables& tables, PhysicsData& data,
                           const Columns& columns, GroupRange groups, bool half) {
  Range range;
  range.groups = groups;
  const gpu::ContextInfo& info = gl.context->info();
  const int fold = fold_of(tables.settings, info.max_texture_3d);
  if (Status uploaded = upload_source(gl, tables, half, fold, range, data); !uploaded)
    return uploaded.error();
  auto physics = PhysicsBuffers::create(gl, data, columns, groups);
  if (!physics) return physics.error();
  range.physics = std::move(physics).value();
  if (!tables.ground_irradiance.empty()) {
    std::vector<float> rows;
    for (int g = groups.first; g < groups.first + groups.count; ++g)
      rows.insert(rows.end(), tables.ground_irradiance[g].begin(),
                  tables.ground_irradiance[g].end());
    range.physics.set_ground(gl, rows);
  }
  range.xyz_weight = gpu::Buffer::of(gl, xyz_weights(tables.medium, groups));
  for (const auto& [program, entry] : {std::pair{&range.slice, "entry/slice.comp"},
                                       std::pair{&range.answer, "entry/answer.comp"}}) {
    auto made = gpu::Program::create(
        gl, entry,
        physics_defines(groups.count, fold, filter_of(info), data.air.layer_count > 0, half));
    if (!made) return made.error();
    *program = std::move(made).value();
  }
  return range;
}

QueryRays query_rays(const Columns& columns, const Query& query) {
  const double h = query.height.in(km);
  assert(std::isfinite(h) && h >= 0);
  Geometry geometry = columns.paths().geometry();
  const double mu_s = cos(query.sun_zenith);
  // 1 - nu = 2 sin^2 of half the angle: exact at the sun, where the aerosol phase is steepest.
  const double a = sin((query.view_zenith - query.sun_zenith) / 2), b = sin(query.azimuth / 2);
  const double nu = 1 - 2 * (a * a + sin(query.view_zenith) * sin(query.sun_zenith) * b * b);
  const double visible = geometry.sun_visibility(h, mu_s);
  const double above_horizon = std::max(mu_s, geometry.horizon_mu(h));
  return {make_ray(columns, h, cos(query.view_zenith)),
          make_ray(columns, h, above_horizon, RaySide::sky),
          mu_s,
          std::clamp(nu, -1.0, 1.0),
          visible,
          0};
}

}  // namespace

/// The rows of a slice on the context, kept from frame to frame.
struct SliceBuffers {
  double height_km = -1;
  SliceGrid grid;
  SliceWindow window;
  gpu::Buffer rows, samples, places;
  std::vector<gpu::Buffer> weights;  // per range of groups
  gpu::Texture profiles;
};

struct GpuModel::State {
  std::shared_ptr<gpu::Context> context;
  atmosphere::Medium medium;
  Settings settings;
  std::shared_ptr<const Columns> columns;
  PhysicsData data;
  bool has_source = false;
  std::vector<Range> ranges;

  /// Of a camera height, grid and rows; only on the context's thread.
  Result<const SliceBuffers*> slice_buffers(const gpu::Functions& gl, double height_km,
                                            const SliceGrid& grid, SliceWindow window);

 private:
  Result<SliceBuffers> make_slice_buffers(const gpu::Functions& gl, double height_km,
                                          const SliceGrid& grid, const SliceWindow& window) const;
  std::list<SliceBuffers> recent_;  // the last few, the last used in front
};

Result<const SliceBuffers*> GpuModel::State::slice_buffers(const gpu::Functions& gl,
                                                           double height_km, const SliceGrid& grid,
                                                           SliceWindow window) {
  window.azimuths = {};  // the lists are the same for all
  for (auto i = recent_.begin(); i != recent_.end(); ++i)
    if (i->height_km == height_km && i->grid == grid && i->window == window) {
      recent_.splice(recent_.begin(), recent_, i);
      return &recent_.front();
    }
  auto buffers = make_slice_buffers(gl, height_km, grid, window);
  if (!buffers) return buffers.error();
  recent_.push_front(*std::move(buffers));
  if (recent_.size() > kSliceBuffersKept) recent_.pop_back();
  return &recent_.front();
}

Result<SliceBuffers> GpuModel::State::make_slice_buffers(const gpu::Functions& gl, double height_km,
                                                         const SliceGrid& grid,
                                                         const SliceWindow& window) const {
  const SliceLists lists = slice_lists(*columns, data, settings, height_km, grid, window);
  SliceBuffers buffers;
  buffers.height_km = height_km;
  buffers.grid = grid;
  buffers.window = window;
  buffers.rows = gpu::Buffer::of(gl, lists.rows);
  buffers.samples = gpu::Buffer::of(gl, lists.samples);
  buffers.places = gpu::Buffer::of(gl, lists.places);
  const size_t groups = data.groups.size(), places = lists.places.size();
  for (const Range& range : ranges) {
    std::vector<glm::vec4> weights;
    for (int g = range.groups.first; g < range.groups.first + range.groups.count; ++g)
      for (size_t i = 0; i < places; ++i) weights.emplace_back(lists.weights[i * groups + g]);
    buffers.weights.push_back(gpu::Buffer::of(gl, weights));
  }
  const int nodes = SliceLists::kProfileNodes, pieces = int(lists.profiles.size()) / nodes;
  auto profiles = gpu::Texture::create(gl, {nodes, pieces}, &lists.profiles[0][0]);
  if (!profiles) return profiles.error();
  buffers.profiles = std::move(profiles).value();
  return buffers;
}

Result<GpuModel> GpuModel::create(std::shared_ptr<gpu::Context> context, const Tables& tables,
                                  ModelOptions options) {
  auto state = std::make_shared<State>();
  state->context = std::move(context);
  state->medium = tables.medium;
  state->columns = make_columns(tables.medium);
  state->has_source = !tables.source.empty();
  state->settings = tables.settings;
  state->data = physics_data(tables.medium, tables.settings, options.samples);
  const Status status = state->context->run([&](const gpu::Functions& gl) -> Status {
    for (const GroupRange groups : group_ranges(tables.groups())) {
      auto range =
          create_range(gl, tables, state->data, *state->columns, groups, options.half_source);
      if (!range) return range.error();
      state->ranges.push_back(std::move(range).value());
    }
    return Done{};
  });
  if (!status) return status.error();
  return GpuModel(std::move(state));
}

Result<SkySlice> GpuModel::slice(Length camera_height, Angle sun_zenith, const SliceGrid& grid,
                                 SliceContent content) const {
  State& state = *state_;
  const SliceWindow window = content.window.value_or(whole_window(grid));
  SkySlice slice = dark_slice(state.medium, sun_zenith, grid, content.window);
  if (window.empty()) return slice;
  const auto block_of = [&](int first_row) {
    return SliceBlock{float(cos(sun_zenith)),
                      grid.azimuths,
                      window.azimuths.begin,
                      window.azimuths.end,
                      first_row,
                      content.multiple_scattering && state.has_source,
                      content.ground,
                      content.aerial_perspective};
  };
  const int half = grid.zeniths / 2, columns = window.azimuths.end - window.azimuths.begin;
  const size_t bytes = slice.smooth.size() * sizeof(glm::vec4);
  const Status status = state.context->run([&](const gpu::Functions& gl) -> Status {
    const gpu::Buffer smooth = gpu::Buffer::create(gl, bytes),
                      aerosol = gpu::Buffer::create(gl, bytes);
    const auto lists = state.slice_buffers(gl, camera_height.in(km), grid, window);
    if (!lists) return lists.error();
    for (size_t i = 0; i < state.ranges.size(); ++i) {
      const Range& range = state.ranges[i];
      range.physics.bind(gl, range.source);
      range.xyz_weight.bind_uniform(gl, 4);
      (*lists)->rows.bind_storage(gl, 1);
      (*lists)->samples.bind_storage(gl, 2);
      (*lists)->places.bind_storage(gl, 6);
      (*lists)->weights[i].bind_storage(gl, 3);
      (*lists)->profiles.bind(gl, unsigned(range.groups.count) + 1);
      smooth.bind_storage(gl, 4);
      aerosol.bind_storage(gl, 5);
      for (const auto& [rows, first] : {std::pair{window.sky, 0}, std::pair{window.ground, half}}) {
        if (rows.empty()) continue;
        const gpu::Buffer uniforms = gpu::Buffer::of_block(gl, block_of(first + rows.begin));
        uniforms.bind_uniform(gl, 3);
        range.slice.dispatch(gl, {gpu::groups_for(columns, kGroupSize), rows.end - rows.begin});
      }
    }
    smooth.read(gl, 0, bytes, slice.smooth.data());
    aerosol.read(gl, 0, bytes, slice.aerosol.data());
    return Done{};
  });
  if (!status) return status.error();
  return slice;
}

Result<std::vector<Answer>> GpuModel::answer(const std::vector<Query>& queries,
                                             SliceContent content) const {
  const State& state = *state_;
  const AnswerBlock block{content.multiple_scattering && state.has_source, content.ground, {}};
  const size_t bands = state.medium.bands.size();
  std::vector<Answer> answers(queries.size());
  for (size_t first = 0; first < queries.size(); first += kQueriesAtOnce) {
    const size_t count = std::min(kQueriesAtOnce, queries.size() - first);
    constexpr size_t kFloats = sizeof(QueryRays) / sizeof(double);
    std::vector<float> rays(count * kFloats);
    parallel_for_ranges(count, 64, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        const std::vector<float> query =
            floats_of_block(query_rays(*state.columns, queries[first + i]));
        std::copy(query.begin(), query.end(), rays.begin() + std::ptrdiff_t(i * kFloats));
      }
    });
    const Status status = state.context->run([&](const gpu::Functions& gl) -> Status {
      const gpu::Buffer uniforms = gpu::Buffer::of_block(gl, block);
      const gpu::Buffer ray_buffer = gpu::Buffer::of(gl, rays);
      for (const Range& range : state.ranges) {
        const size_t groups = size_t(range.groups.count);
        std::vector<glm::vec4> values(3 * groups * count);
        const gpu::Buffer results = gpu::Buffer::create(gl, values.size() * sizeof(glm::vec4));
        range.physics.bind(gl, range.source);
        uniforms.bind_uniform(gl, 3);
        ray_buffer.bind_storage(gl, 1);
        results.bind_storage(gl, 2);
        range.answer.dispatch(gl, {gpu::groups_for(int(count), kGroupSize)});
        results.read(gl, 0, results.bytes(), values.data());
        for (size_t i = 0; i < count; ++i)
          for (size_t c = 0; c < 4 * groups && 4 * range.groups.first + c < bands; ++c) {
            const glm::vec4* at = &values[3 * (i * groups + c / 4)];
            Answer& answer = answers[first + i];
            answer.radiance.push_back(double(at[0][int(c % 4)]));
            answer.transmittance.push_back(double(at[1][int(c % 4)]));
            answer.sun_transmittance.push_back(double(at[2][int(c % 4)]));
          }
      }
      return Done{};
    });
    if (!status) return status.error();
  }
  return answers;
}

}  // namespace skylapse::sky::bruneton
