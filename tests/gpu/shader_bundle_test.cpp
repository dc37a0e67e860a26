#include "gpu/shader_bundle.h"

#include <gmock/gmock.h>

namespace skylapse::gpu {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<ShaderFile> kFiles{
    {"a.comp", "first\n#include \"lib/b.glsl\"\nthird\n"},
    {"lib/b.glsl", "#pragma once\nsecond\n"},
    {"lost.comp", "one\n  #include \"lib/c.glsl\"\n"},
    {"loop.comp", "#include \"loop.comp\"\n"},
};

TEST(ShaderBundle, PutsIncludesInPlaceWithTheirLines) {
  const auto bundle = bundle_shader("a.comp", {{"N", 3}}, kFiles);
  ASSERT_TRUE(bundle.ok());
  EXPECT_EQ(bundle->text,
            "#version 450 core\n#define N 3\n#line 1 0\nfirst\n#line 1 1\n\nsecond\n"
            "#line 3 0\nthird\n");
  EXPECT_THAT(bundle->files, ElementsAre("shaders/a.comp", "shaders/lib/b.glsl"));
}

TEST(ShaderBundle, UnknownIncludeIsAnErrorAtItsPlaceWithTheNearestName) {
  const auto bundle = bundle_shader("lost.comp", {}, kFiles);
  ASSERT_FALSE(bundle.ok());
  EXPECT_EQ(bundle.error().span.file, "shaders/lost.comp");
  EXPECT_EQ(bundle.error().span.line, 2);
  EXPECT_EQ(bundle.error().span.column, 13);
  EXPECT_THAT(bundle.error().hint, HasSubstr("lib/b.glsl"));
}

TEST(ShaderBundle, FileThatIncludesItselfIsAnError) {
  const auto bundle = bundle_shader("loop.comp", {}, kFiles);
  ASSERT_FALSE(bundle.ok());
  EXPECT_THAT(bundle.error().message, HasSubstr("includes itself"));
}

TEST(ShaderBundle, UnknownEntryIsAnError) {
  EXPECT_FALSE(bundle_shader("none.comp", {}, kFiles).ok());
}

TEST(ShaderBundle, MessagesOfThreeDriversAreMapped) {
  const ShaderBundle bundle{"", {"shaders/a.comp", "shaders/lib/b.glsl"}};
  EXPECT_EQ(map_compiler_log(bundle, "1:12(7): error: `x' undeclared"),
            "shaders/lib/b.glsl:12: error: `x' undeclared");
  EXPECT_EQ(map_compiler_log(bundle, "1(12) : error C1503: undefined variable"),
            "shaders/lib/b.glsl:12: error C1503: undefined variable");
  EXPECT_EQ(map_compiler_log(bundle, "ERROR: 0:3: 'x' : undeclared"),
            "shaders/a.comp:3: 'x' : undeclared");
}

TEST(ShaderBundle, MessagesOfNoKnownFormStayAsTheyAre) {
  const ShaderBundle bundle{"", {"shaders/a.comp"}};
  EXPECT_EQ(map_compiler_log(bundle, "out of registers\n7:1(1): error: z"),
            "out of registers\n7:1(1): error: z");
}

}  // namespace
}  // namespace skylapse::gpu
