#include "config/path_template.h"

#include <gtest/gtest.h>

namespace skylapse::config {
namespace {

TEST(PathTemplate, KnownTokensAndOneFrameNumberAreFine) {
  for (const char* path :
       {"sky.####.png", "{site}/{date}_{time}.exr", "a#.png", "out/x.png",
        "{camera}-{turbidity}-{albedo}-{face}-{sun_elevation}.######.hdr", "./x.png",
        "/mnt/my disk/x.png", "čas.####.png", "{site}_{date}_{half}_{size}_{level}_{face}.ktx2"})
    EXPECT_FALSE(path_template_problem(path).has_value()) << path;
}

TEST(PathTemplate, AnUnknownTokenIsMarkedAndTheNearestNamed) {
  const auto problem = path_template_problem("out/{sit}.####.png");
  ASSERT_TRUE(problem.has_value());
  EXPECT_EQ(problem->message, "the token {sit} is not known");
  EXPECT_EQ(problem->hint, "did you mean {site}?");
  EXPECT_EQ(problem->begin, 4u);
  EXPECT_EQ(problem->length, 5u);
}

TEST(PathTemplate, NamesThatCannotBeFilesAreRefused) {
  const std::string long_name(201, 'x'), long_path(1001, 'x');
  for (const std::string& path :
       {std::string(), std::string("out/"), std::string("a##b##.png"), std::string("{site.png"),
        std::string("site}.png"), std::string("{}.png"), std::string("{{site}}.png"),
        std::string("a\nb.png"), std::string("a\\b.png"), std::string("a\0b.png", 7),
        std::string("#############.png"), long_name, "a/" + long_name, long_path,
        std::string("{si/te}.png"), std::string("a b.png")})
    EXPECT_TRUE(path_template_problem(path).has_value()) << path;
}

TEST(PathTemplate, LeavingTheOutputFolderIsSeenThroughDetours) {
  for (const char* path : {"/tmp/x.png", "../x.png", "a/../../x.png", "./../x.png",
                           "a/b/../../../x", "a//../../x.png", ".."})
    EXPECT_TRUE(leaves_folder(path)) << path;
  for (const char* path :
       {"x.png", "a/../x.png", "a/b/../../x.png", "..x/y.png", "a/./b.png", "...", "{site}/x.png"})
    EXPECT_FALSE(leaves_folder(path)) << path;
}

TEST(PathTemplate, PathsOfOneFileHaveOneNormalSpelling) {
  for (const char* path : {"a/b.png", "./a/b.png", "a//b.png", "a/./b.png", "a/c/../b.png"})
    EXPECT_EQ(normalised_path(path), "a/b.png") << path;
  EXPECT_EQ(normalised_path("../a//b.png"), "../a/b.png");
  EXPECT_EQ(normalised_path("{site}/####.png"), "{site}/####.png");
}

TEST(PathTemplate, RecordsOfTheProgramLieAtTheTopAlone) {
  for (const char* path : {"manifest.json", ".skylapse", ".skylapse/x.png", "manifest.json/x.png"})
    EXPECT_TRUE(is_reserved_path(path)) << path;
  for (const char* path : {"a/manifest.json", "a/.skylapse/x.png", "manifest.json.png"})
    EXPECT_FALSE(is_reserved_path(path)) << path;
}

TEST(PathTemplate, TokensAndEndingsAreFound) {
  EXPECT_EQ(tokens_in("{site}/a.####.{time}.png"), (std::vector<std::string>{"site", "#", "time"}));
  EXPECT_TRUE(tokens_in("plain.png").empty());
  EXPECT_EQ(extension_of("a.b/c.EXR"), "exr");
  EXPECT_EQ(extension_of("a.b/c"), "");
  EXPECT_EQ(extension_of(".png"), "");
}

TEST(PathTemplate, AQuestionMarkIsRefusedAtItsPlace) {
  const auto problem = path_template_problem("maps/a?b.####.exr");
  ASSERT_TRUE(problem.has_value());
  EXPECT_EQ(problem->message, "the name holds a question mark");
  EXPECT_EQ(problem->begin, 6U);
}

}  // namespace
}  // namespace skylapse::config
