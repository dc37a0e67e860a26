#include "gpu/program.h"

#include <gmock/gmock.h>

#include "gpu/any_context.h"
#include "gpu/buffer.h"
#include "gpu/functions.h"

namespace skylapse::gpu {
namespace {

using testing::HasSubstr;

class AnyProgram : public AnyContext {
 protected:
  /// What creating the entry "entry.comp" of these files says; empty if it works.
  std::string message_of(const std::vector<ShaderFile>& files,
                         const std::vector<Define>& defines = {}) {
    const Status status = context_->run([&](const Functions& gl) -> Status {
      const auto program = Program::create(gl, "entry.comp", defines, files);
      return program ? Status(Done{}) : Status(program.error());
    });
    return status ? "" : format_error(status.error());
  }
};

constexpr ShaderFile kGoodPhase{"physics/phase.glsl",
                                "#pragma once\n\nfloat phase(float nu) {\n  return nu * nu;\n}\n"};

TEST_P(AnyProgram, CompileErrorNamesTheEntrysOwnLine) {
  const ShaderFile entry{"entry.comp",
                         "#include \"physics/phase.glsl\"\nlayout(local_size_x = 1) in;\n"
                         "void main() {\n  float x = wrong_name;\n}\n"};
  EXPECT_THAT(message_of({kGoodPhase, entry}), HasSubstr("shaders/entry.comp:4: "));
}

TEST_P(AnyProgram, CompileErrorNamesTheIncludedFilesLine) {
  const ShaderFile phase{"physics/phase.glsl",
                         "#pragma once\n\nfloat phase(float nu) {\n  return nu * mistake;\n}\n"};
  const ShaderFile entry{"entry.comp",
                         "layout(local_size_x = 1) in;\n#include \"physics/phase.glsl\"\n"
                         "void main() {}\n"};
  const std::string message = message_of({phase, entry});
  EXPECT_THAT(message, HasSubstr("shaders/physics/phase.glsl:4: "));
  EXPECT_THAT(message, HasSubstr("mistake"));
  EXPECT_THAT(message, HasSubstr("compilation of shaders/entry.comp failed"));
}

TEST_P(AnyProgram, CompileErrorAfterAnIncludeNamesTheLineBehindIt) {
  const ShaderFile entry{"entry.comp",
                         "layout(local_size_x = 1) in;\n#include \"physics/phase.glsl\"\n"
                         "void main() { int i = mistake; }\n"};
  EXPECT_THAT(message_of({kGoodPhase, entry}), HasSubstr("shaders/entry.comp:3: "));
}

TEST_P(AnyProgram, FileIncludedTwiceIsTakenOnce) {
  const ShaderFile other{"physics/other.glsl",
                         "#include \"physics/phase.glsl\"\nfloat f() { return phase(1.0); }\n"};
  const ShaderFile entry{
      "entry.comp",
      "#include \"physics/other.glsl\"\n#include \"physics/phase.glsl\"\n"
      "layout(local_size_x = 1) in;\nvoid main() { float x = f() + phase(0.5); }\n"};
  EXPECT_EQ(message_of({kGoodPhase, other, entry}), "");
}

TEST_P(AnyProgram, DefinesShapeTheShader) {
  const ShaderFile entry{"entry.comp",
                         "layout(local_size_x = SIDE) in;\n"
                         "layout(std430, binding = 0) buffer Out { float values[]; };\n"
                         "void main() { values[gl_LocalInvocationIndex] = float(SIDE); }\n"};
  std::vector<float> values(7, -1.0f);
  const Status status = context_->run([&](const Functions& gl) -> Status {
    const auto program = Program::create(gl, "entry.comp", {{"SIDE", 7}}, {{entry}});
    if (!program) return program.error();
    const Buffer buffer = Buffer::of(gl, values);
    buffer.bind_storage(gl, 0);
    program->dispatch(gl, {});
    buffer.read(gl, 0, buffer.bytes(), values.data());
    return Done{};
  });
  ASSERT_TRUE(status.ok()) << status.error().message;
  EXPECT_THAT(values, testing::Each(7.0f));
  EXPECT_THAT(message_of({entry}), HasSubstr("SIDE"));
}

TEST_P(AnyProgram, FailedCompilationLeavesTheContextInOrder) {
  const ShaderFile entry{"entry.comp", "nonsense\n"};
  EXPECT_NE(message_of({entry}), "");
  EXPECT_TRUE(context_->run([](const Functions&) -> Status { return Done{}; }).ok());
}

SKYLAPSE_ON_EVERY_CONTEXT(AnyProgram);

}  // namespace
}  // namespace skylapse::gpu
