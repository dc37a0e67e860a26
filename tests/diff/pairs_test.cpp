// Which file belongs to which.
#include "diff/pairs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "diff/file_names.h"
#include "pipeline/job_fixture.h"

namespace skylapse::diff {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

void touch(const fs::path& path, const std::string& text = "x") {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

/// A folder A with eight frames and an equal B.
struct TwoFolders {
  TemporaryFolder folder;
  fs::path a = folder / "A", b = folder / "B";
  TwoFolders() {
    for (const auto& side : {a, b})
      for (int i = 1; i <= 8; ++i) touch(side / ("f.000" + std::to_string(i) + ".exr"));
  }
  [[nodiscard]] PairList pairs(const std::vector<std::string>& ignore = {}) const {
    auto list = pair_files(a.string(), b.string(), ignore);
    if (!list) {
      ADD_FAILURE() << list.error().message;
      return {};
    }
    return *std::move(list);
  }
};

std::vector<std::string> checks_of(const PairList& list) {
  std::vector<std::string> checks;
  for (const Finding& f : list.findings) checks.push_back(f.check);
  return checks;
}

TEST(PairFiles, FramesOfTwoFoldersGoTogetherAsOneSequence) {
  const TwoFolders both;
  const auto list = both.pairs();
  ASSERT_EQ(list.pairs.size(), 8u);
  EXPECT_TRUE(list.findings.empty());
  for (const FilePair& pair : list.pairs) {
    EXPECT_EQ(pair.sequence, 0);
    EXPECT_EQ(pair.a, (both.a / pair.name).string());
    EXPECT_EQ(pair.b, (both.b / pair.name).string());
  }
}

TEST(PairFiles, MissingAndExtraFramesAreFailures) {
  TwoFolders both;
  fs::remove(both.b / "f.0005.exr");
  touch(both.b / "f.0009.exr");
  const auto list = both.pairs();
  EXPECT_EQ(list.pairs.size(), 7u);
  EXPECT_THAT(checks_of(list), ElementsAre("sequence.missing", "sequence.extra"));
  for (const Finding& f : list.findings) EXPECT_EQ(f.severity, Verdict::different);
}

TEST(PairFiles, ManifestsThumbnailsAndHiddenFilesAreInnocent) {
  TwoFolders both;
  touch(both.b / "manifest.json", "{}");
  fs::create_directories(both.b / "thumbs");
  touch(both.b / ".skylapse/x.exr");
  touch(both.b / ".hidden.exr");
  touch(both.b / "notes.txt");
  EXPECT_TRUE(both.pairs().findings.empty());
  touch(both.b / "thumbs/f.0001.exr");
  touch(both.b / "thumbs/small/f.0001.exr");
  const auto list = both.pairs();
  ASSERT_THAT(checks_of(list), ElementsAre("folder.extra"));
  EXPECT_EQ(list.findings[0].severity, Verdict::warning);
  EXPECT_NE(list.findings[0].message.find("'thumbs' with 2 images"), std::string::npos);
  touch(both.b / "manifest.json", "{\"frames\": [");
  EXPECT_THAT(checks_of(both.pairs()), ElementsAre("manifest", "folder.extra"));
}

TEST(PairFiles, AnyNameWillDo) {
  TwoFolders both;
  const std::vector<std::string> odd{"a b/\xc3\xa9 1.exr",  "new\nline.exr", "latin\xe9.exr",
                                     "question?mark=1.exr", "UPPER.EXR",     "-dash.png"};
  for (const auto& name : odd)
    for (const auto& side : {both.a, both.b}) touch(side / name);
  const auto list = both.pairs();
  EXPECT_TRUE(list.findings.empty());
  EXPECT_EQ(list.pairs.size(), 8u + odd.size());
  fs::remove(both.b / odd[2]);
  for (const Finding& f : both.pairs().findings)
    EXPECT_EQ(f.message, "A has 'latin?.exr', B has not");
}

TEST(PairFiles, LinksAreFollowedAndLoopsEnd) {
  TwoFolders both;
  fs::create_directory_symlink(both.a, both.folder / "link");
  const auto linked = pair_files((both.folder / "link").string(), both.b.string(), {});
  ASSERT_TRUE(linked.ok());
  EXPECT_EQ(linked->pairs.size(), 8u);
  fs::create_directory_symlink(both.b, both.b / "loop");
  fs::create_directory_symlink("..", both.a / "up");
  const auto list = both.pairs();  // "up" holds A's neighbours, B among them
  EXPECT_GE(list.pairs.size(), 8u);
  fs::create_symlink("nowhere.exr", both.b / "f.0009.exr");
  EXPECT_THAT(checks_of(both.pairs()), testing::Contains("sequence.extra"));
}

TEST(PairFiles, IgnoredNamesAreLeftOutOfBothSides) {
  TwoFolders both;
  fs::remove(both.b / "f.0005.exr");
  touch(both.a / "preview/p.png");
  const auto list = both.pairs({"f.0005.*", "preview/"});
  EXPECT_TRUE(list.findings.empty());
  EXPECT_EQ(list.pairs.size(), 7u);
}

TEST(PairFiles, WhatDoesNotGoTogetherIsAnError) {
  TwoFolders both;
  const auto file = (both.a / "f.0001.exr").string();
  EXPECT_EQ(pair_files(file, both.b.string(), {}).error().code, ErrorCode::invalid_input);
  EXPECT_EQ(pair_files(both.a.string(), (both.folder / "C").string(), {}).error().code,
            ErrorCode::missing_input);
  fs::create_directories(both.folder / "empty");
  EXPECT_EQ(pair_files((both.folder / "empty").string(), both.b.string(), {}).error().code,
            ErrorCode::missing_input);
  const auto nothing_in_b = pair_files(both.a.string(), (both.folder / "empty").string(), {});
  ASSERT_TRUE(nothing_in_b.ok());
  EXPECT_EQ(nothing_in_b->findings.size(), 8u);
}

std::string manifest(const std::string& files) {
  return "{\"program\": \"skylapse\", \"version\": \"9\", \"frames\": [" + files + "]}";
}

TEST(PairFiles, HostileManifestsAreErrorsWithAReason) {
  TwoFolders both;
  const auto path = [&](const std::string& text) {
    touch(both.a / "manifest.json", text);
    return (both.a / "manifest.json").string();
  };
  std::string deep(100000, '[');
  for (const std::string& text :
       {std::string("{}"), std::string("["), std::string("\xff"), manifest("3"),
        manifest("{\"files\": [3]}"), manifest("{\"files\": [{\"path\": \"/etc/passwd\"}]}"),
        manifest("{\"files\": [{\"path\": \"a/../../b.exr\"}]}"), deep,
        manifest("{\"files\": [{\"path\": \"a.exr\"}, {\"path\": \"a.exr\"}]}")}) {
    const auto list = pair_files(path(text), path(text), {});
    ASSERT_FALSE(list.ok()) << text.substr(0, 80);
    EXPECT_EQ(list.error().code, ErrorCode::missing_input);
    EXPECT_FALSE(list.error().message.empty());
  }
  const auto broken = pair_files(path("{\n \"a\": }"), path("{\n \"a\": }"), {});
  EXPECT_EQ(broken.error().span.line, 2);
}

TEST(PairFiles, ManifestsTellSequencesAndFacts) {
  using namespace pipeline::testing;
  const auto plan = plan_of_text(
      small_scene("{image: \"exr/{time}.exr\"}, {image: \"hdr/####.hdr\"}, {image: \"f.####.png\", "
                  "display: sRGB}"));
  const TemporaryFolder folder;
  ASSERT_TRUE(pipeline::run_job(plan, options_for(plan, folder.path())).ok());
  const auto root = folder.path().string();
  for (const bool as_manifest : {false, true}) {
    const std::string path = as_manifest ? root + "/manifest.json" : root;
    const auto list = pair_files(path, path, {});
    ASSERT_TRUE(list.ok()) << list.error().message;
    EXPECT_TRUE(list->findings.empty());
    ASSERT_EQ(list->pairs.size(), 18u);
    std::map<int, int> frames_of;
    for (const FilePair& pair : list->pairs) {
      ++frames_of[pair.sequence];
      EXPECT_NE(pair.manifest_entry_a.find("\"utc\":\"2026-06-21T"), std::string::npos);
      EXPECT_EQ(pair.renderer_b, "cpu");
    }
    EXPECT_THAT(frames_of,
                ElementsAre(testing::Pair(0, 6), testing::Pair(1, 6), testing::Pair(2, 6)));
  }
  const auto below = pair_files(root + "/hdr", root + "/hdr", {});
  ASSERT_TRUE(below.ok());
  EXPECT_FALSE(below->pairs[0].manifest_entry_a.empty()) << "the manifest above tells, too";
}

TEST(FileNames, NumbersAreOrderedAsNumbers) {
  std::vector<std::string> names{"f.10.exr", "f.9.exr", "f.09.exr", "a",
                                 "f.9.a",    "b2/f1",   "b10/f1"};
  std::sort(names.begin(), names.end(), comes_before);
  EXPECT_THAT(names,
              ElementsAre("a", "b2/f1", "b10/f1", "f.9.a", "f.09.exr", "f.9.exr", "f.10.exr"));
  EXPECT_FALSE(comes_before("x", "x"));
}

TEST(FileNames, SequencesDifferInOneNumber) {
  EXPECT_THAT(sequences_of({"f.1.exr", "f.2.exr", "g.exr", "cam1/f.1.exr", "cam1/f.2.exr",
                            "cam2/f.1.exr", "cam2/f.2.exr", "f.1.png"}),
              ElementsAre(2, 2, -1, 0, 0, 1, 1, -1));
  EXPECT_THAT(
      sequences_of({"2026-06-21T10-00.exr", "2026-06-21T10-10.exr", "2026-06-22T09-00.exr"}),
      ElementsAre(0, 0, 0));
}

TEST(Glob, StarsStayWithinFoldersAndDoubleStarsDoNot) {
  struct Case {
    const char *name, *pattern;
    bool fits;
  };
  const Case cases[] = {{"f.0001.exr", "*.exr", true},
                        {"site/f.0001.exr", "*.exr", true},
                        {"site/f.0001.exr", "site/*.exr", true},
                        {"site/a/f.exr", "site/*.exr", false},
                        {"site/a/f.exr", "site/**.exr", true},
                        {"site/a/f.exr", "**/f.exr", true},
                        {"f.exr", "**/f.exr", true},
                        {"a/xf.exr", "**/f.exr", false},
                        {"a/b/c.exr", "a/**/c.exr", true},
                        {"a/c.exr", "a/**/c.exr", true},
                        {"a/b/c.exr", "a/", true},
                        {"ab/c.exr", "a/", false},
                        {"f.0001.exr", "f.000[1-3].exr", true},
                        {"f.0001.exr", "f.000[!1].exr", false},
                        {"f[1].exr", "f[[]1].exr", true},
                        {"f.exr", "?.exr", true},
                        {"a/b.exr", "a?b.exr", false},
                        {"f.exr", "", false},
                        {"a[b", "a[b", true}};
  for (const Case& c : cases)
    EXPECT_EQ(fits_glob(c.name, c.pattern), c.fits) << c.name << " " << c.pattern;
}

}  // namespace
}  // namespace skylapse::diff
