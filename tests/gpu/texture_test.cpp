#include "gpu/texture.h"

#include <gmock/gmock.h>

#include <cmath>
#include <glm/glm.hpp>

#include "gpu/any_context.h"
#include "gpu/buffer.h"
#include "gpu/functions.h"
#include "gpu/program.h"

namespace skylapse::gpu {
namespace {

using testing::HasSubstr;

constexpr ShaderFile kLookup{
    "entry.comp",
    "layout(local_size_x = 16) in;\n"
    "layout(binding = 0) uniform sampler3D table;\n"
    "layout(std430, binding = 0) buffer Points { vec4 points[]; };\n"
    "void main() {\n"
    "  uint i = gl_GlobalInvocationID.x;\n"
    "  if (i < uint(points.length())) points[i] = textureLod(table, points[i].xyz, 0.0);\n"
    "}\n"};

constexpr TextureSize kSize{3, 4, 5};

/// A function that trilinear interpolation reproduces exactly.
glm::vec4 trilinear_function(float x, float y, float z) {
  return {x, 2 * y - z, x * y * z, 7 - x * z};
}

std::vector<float> texels_of_function() {
  std::vector<float> texels;
  for (int z = 0; z < kSize.depth; ++z)
    for (int y = 0; y < kSize.height; ++y)
      for (int x = 0; x < kSize.width; ++x) {
        const glm::vec4 value = trilinear_function(float(x), float(y), float(z));
        for (int c = 0; c < 4; ++c) texels.push_back(value[c]);
      }
  return texels;
}

class AnyTexture : public AnyContext {
 protected:
  /// The texture's answers at points in texels, node i of an axis at i.
  Result<std::vector<glm::vec4>> look_up(std::vector<glm::vec4> points) {
    for (glm::vec4& p : points)
      p = (p + 0.5f) / glm::vec4(kSize.width, kSize.height, kSize.depth, 1);
    const Status status = context_->run([&](const Functions& gl) -> Status {
      const auto program = Program::create(gl, "entry.comp", {}, {{kLookup}});
      if (!program) return program.error();
      const auto texture = Texture::create(gl, kSize, texels_of_function().data());
      if (!texture) return texture.error();
      const Buffer buffer = Buffer::of(gl, points);
      texture->bind(gl, 0);
      buffer.bind_storage(gl, 0);
      program->dispatch(gl, {groups_for(int(points.size()), 16)});
      buffer.read(gl, 0, buffer.bytes(), points.data());
      return Done{};
    });
    if (!status) return status.error();
    return points;
  }
};

TEST_P(AnyTexture, InterpolatesAlongAllThreeAxes) {
  std::vector<glm::vec4> points;
  for (int i = 0; i < 500; ++i)
    points.emplace_back(2 * std::fmod(0.37 * i, 1.0), 3 * std::fmod(0.61 * i, 1.0),
                        4 * std::fmod(0.83 * i, 1.0), 0);
  const auto answers = look_up(points);
  ASSERT_TRUE(answers.ok()) << answers.error().message;
  // A sampler in hardware may keep 8 bits of the weights; the function's slope is at most 6 x 4.
  const float tolerance = context_->info().software ? 2e-5f : 3 * 24.0f / 256;
  for (size_t i = 0; i < points.size(); ++i) {
    const glm::vec4 expected = trilinear_function(points[i].x, points[i].y, points[i].z);
    for (int c = 0; c < 4; ++c) EXPECT_NEAR((*answers)[i][c], expected[c], tolerance) << i;
  }
}

TEST_P(AnyTexture, IsClampedAtItsEdges) {
  const auto answers = look_up({{-5, -5, -5, 0}, {9, 9, 9, 0}});
  ASSERT_TRUE(answers.ok()) << answers.error().message;
  EXPECT_EQ((*answers)[0], trilinear_function(0, 0, 0));
  EXPECT_EQ((*answers)[1], trilinear_function(2, 3, 4));
}

TEST_P(AnyTexture, ReadsWhatWasWritten) {
  const std::vector<float> texels = texels_of_function();
  std::vector<float> read;
  const Status status = context_->run([&](const Functions& gl) -> Status {
    const auto texture = Texture::create(gl, kSize, texels.data());
    if (!texture) return texture.error();
    read = texture->read(gl);
    return Done{};
  });
  ASSERT_TRUE(status.ok()) << status.error().message;
  EXPECT_EQ(read, texels);
}

TEST_P(AnyTexture, SizeAboveTheLimitIsAnErrorThatNamesTheLimit) {
  const int limit = context_->info().max_texture_3d;
  const Status status = context_->run([&](const Functions& gl) -> Status {
    const auto texture = Texture::create(gl, {1, limit + 1, 1}, nullptr);
    return texture ? Status(Done{}) : Status(texture.error());
  });
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, HasSubstr(std::to_string(limit)));
}

SKYLAPSE_ON_EVERY_CONTEXT(AnyTexture);

TEST(TextureParity, EglAndOsMesaInterpolateAlikeOnOneDriver) {
  const auto egl = test_context(Backend::egl), osmesa = test_context(Backend::osmesa);
  ASSERT_TRUE(egl && osmesa);
  std::vector<glm::vec4> points, answers[2];
  for (int i = 0; i < 200; ++i)
    points.emplace_back(std::fmod(0.37 * i, 1.0), std::fmod(0.61 * i, 1.0),
                        std::fmod(0.83 * i, 1.0), 0);
  for (int which = 0; which < 2; ++which) {
    answers[which] = points;
    const Status status = (which == 0 ? egl : osmesa)->run([&](const Functions& gl) -> Status {
      const auto program = Program::create(gl, "entry.comp", {}, {{kLookup}});
      if (!program) return program.error();
      const auto texture = Texture::create(gl, kSize, texels_of_function().data());
      if (!texture) return texture.error();
      const Buffer buffer = Buffer::of(gl, points);
      texture->bind(gl, 0);
      buffer.bind_storage(gl, 0);
      program->dispatch(gl, {groups_for(int(points.size()), 16)});
      buffer.read(gl, 0, buffer.bytes(), answers[which].data());
      return Done{};
    });
    ASSERT_TRUE(status.ok()) << status.error().message;
  }
  const bool one_driver = egl->info().renderer == osmesa->info().renderer;
  for (size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < 4; ++c) {
      if (one_driver)
        EXPECT_EQ(answers[0][i][c], answers[1][i][c]) << i;
      else  // 8 bits of the weights, as above
        EXPECT_NEAR(answers[0][i][c], answers[1][i][c], 3 * 24.0f / 256) << i;
    }
}

}  // namespace
}  // namespace skylapse::gpu
