// The interpolation by hand that hardware samplers make necessary, against the samplers of
// software.
#include <gmock/gmock.h>

#include <cmath>

#include "gpu/buffer.h"
#include "gpu/functions.h"
#include "gpu/program.h"
#include "parity/twins.h"
#include "sky/bruneton/physics_buffers.h"

namespace skylapse::sky::bruneton {
namespace {

constexpr gpu::ShaderFile kEntry{
    "entry/filter_test.comp",
    "layout(local_size_x = 32) in;\n"
    "#include \"shared/physics_host.glsl\"\n"
    "layout(std430, binding = 1) buffer Points { vec4 points[]; };\n"
    "void main() {\n"
    "  uint i = gl_GlobalInvocationID.x;\n"
    "  if (i >= uint(points.length())) return;\n"
    "  vec4 p = points[i];\n"
    "  points[i] = p.w < 0.5 ? fetch_source(0, p.xyz) : vec4(fetch_columns(p.xy), 0.0);\n"
    "}\n"};

std::vector<glm::vec4> looked_up(gpu::Context& context, Filter filter,
                                 std::vector<glm::vec4> points) {
  const Tables& tables = *reference_tables();
  const Columns columns(tables.medium);
  std::vector<gpu::ShaderFile> files(gpu::shader_files().begin(), gpu::shader_files().end());
  files.push_back(kEntry);
  const Status status = context.run([&](const gpu::Functions& gl) -> Status {
    const auto program =
        gpu::Program::create(gl, kEntry.path, physics_defines(1, 1, filter, false), files);
    if (!program) return program.error();
    const auto physics = PhysicsBuffers::create(gl, physics_data(tables.medium, tables.settings, 2),
                                                columns, {0, 1});
    if (!physics) return physics.error();
    std::vector<gpu::Texture> source;
    source.push_back(value_of(
        gpu::Texture::create(gl, source_size(tables.settings, 1), tables.source[0].data())));
    physics->bind(gl, source);
    const gpu::Buffer buffer = gpu::Buffer::of(gl, points);
    buffer.bind_storage(gl, 1);
    program->dispatch(gl, {gpu::groups_for(int(points.size()), 32)});
    buffer.read(gl, 0, buffer.bytes(), points.data());
    return Done{};
  });
  EXPECT_TRUE(status.ok()) << (status ? "" : status.error().message);
  return points;
}

using AnyFilter = gpu::AnyContext;

TEST_P(AnyFilter, ByHandIsTheSamplersInSoftware) {
  if (!context_->info().software) GTEST_SKIP() << "this driver's samplers are not exact";
  const gpu::TextureSize size = source_size(reference_tables()->settings, 1);
  const Tables& tables = *reference_tables();
  const text::AirParameters air = air_parameters(tables.medium, tables.settings);
  std::vector<glm::vec4> points;
  for (int i = 0; i < 2000; ++i) {
    const auto share = [&](double step) { return std::fmod(step * i, 1.0); };
    if (i % 2 == 0)  // a little past the edges, too
      points.emplace_back(share(0.371) * size.width - 0.5, share(0.617) * size.height - 0.5,
                          share(0.839) * size.depth - 0.5, 0);
    else
      points.emplace_back(share(0.371) * (air.columns_height_last + 1) - 0.5,
                          share(0.617) * (air.columns_distance_last + 1) - 0.5, 0, 1);
  }
  const auto sampled = looked_up(*context_, Filter::sampler, points);
  const auto exact = looked_up(*context_, Filter::exact, points);
  float brightest[2] = {0, 0};
  for (size_t i = 0; i < points.size(); ++i)
    brightest[i % 2] = std::max(brightest[i % 2], sampled[i].x);
  for (size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < 4; ++c)  // coordinates up to 1e3 texels, in float
      EXPECT_NEAR(sampled[i][c], exact[i][c], 1e-4 * brightest[i % 2]) << i;
}

SKYLAPSE_ON_EVERY_CONTEXT(AnyFilter);

}  // namespace
}  // namespace skylapse::sky::bruneton
