// Accepted pictures: written with provenance, chosen by renderer, hostile lists refused.
#include "diff/goldens.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "output/atomic_file.h"
#include "pipeline/job_fixture.h"

namespace skylapse::diff {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

const std::string kLlvm = "llvmpipe (LLVM 15.0.6, 256 bits)";

std::string text_of(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Two rendered frames, and a folder for goldens.
struct Rendered {
  TemporaryFolder folder;
  std::string golden = (folder / "golden").string();
  std::vector<FilePair> files;
  explicit Rendered(std::vector<long> frames = {5, 6}) {
    using namespace pipeline::testing;
    const auto plan = plan_of_text(small_scene("{image: \"p.####.exr\", size: 12x8}"));
    auto options = options_for(plan, folder / "out");
    options.frames = std::move(frames);
    EXPECT_TRUE(pipeline::run_job(plan, options).ok());
    const auto list = list_files((folder / "out").string(), {});
    EXPECT_TRUE(list.ok());
    if (list) files = list->pairs;
  }
};

TEST(Goldens, AreWrittenWithTheirProvenanceAndReadBack) {
  const Rendered run;
  ASSERT_TRUE(update_goldens({run.golden, "", "looked at by Ada"}, run.files).ok());
  const auto goldens = read_goldens(run.golden);
  ASSERT_TRUE(goldens.ok()) << goldens.error().message;
  ASSERT_EQ(goldens->size(), 2u);
  const Golden& first = goldens->front();
  EXPECT_EQ(first.name, "p.0005.exr");
  ASSERT_EQ(first.variants.size(), 1u);
  const GoldenVariant& v = first.variants.front();
  EXPECT_EQ(v.renderer, "cpu");
  EXPECT_EQ(v.file, "cpu/p.0005.exr");
  EXPECT_EQ(v.sha256.size(), 64u);
  EXPECT_THAT(v.program, testing::StartsWith("skylapse "));
  EXPECT_FALSE(v.source_hash.empty());
  EXPECT_EQ(v.config, "scene.yaml");
  EXPECT_EQ(v.model, "hosek-wilkie");
  EXPECT_THAT(v.utc, testing::StartsWith("2026-06-21T"));
  EXPECT_EQ(v.note, "looked at by Ada");
  EXPECT_EQ(text_of(fs::path(run.golden) / v.file), text_of(run.files[0].b));
  EXPECT_TRUE(*is_as_accepted(run.golden, v));
  std::ofstream(fs::path(run.golden) / v.file, std::ios::app) << "x";
  EXPECT_FALSE(*is_as_accepted(run.golden, v));
}

TEST(Goldens, KeepThoseOfOtherRenderersAndOnlyWhatChangedChanges) {
  const Rendered run;
  ASSERT_TRUE(update_goldens({run.golden, "cpu", "first"}, run.files).ok());
  ASSERT_TRUE(update_goldens({run.golden, kLlvm, "second"}, {run.files[0]}).ok());
  const auto before = text_of(fs::path(run.golden) / "golden.json");
  ASSERT_TRUE(update_goldens({run.golden, "cpu", "third"}, run.files).ok());
  EXPECT_EQ(text_of(fs::path(run.golden) / "golden.json"), before) << "the same bytes again";
  const auto goldens = read_goldens(run.golden);
  ASSERT_TRUE(goldens.ok());
  ASSERT_EQ((*goldens)[0].variants.size(), 2u);
  EXPECT_EQ((*goldens)[1].variants.size(), 1u);
  EXPECT_EQ(variants_for((*goldens)[0], kLlvm)[0].renderer, kLlvm);
  EXPECT_EQ(variants_for((*goldens)[0], "llvmpipe (LLVM 16, 128 bits)")[0].renderer, kLlvm);
  EXPECT_EQ(variants_for((*goldens)[0], "cpu")[0].renderer, "cpu");
}

TEST(Goldens, PlainFoldersAreGoldensOfAnUnknownRenderer) {
  const Rendered run;
  fs::create_directories(run.golden + "/day");
  fs::copy(run.files[0].b, run.golden + "/day/p.0005.exr");
  const auto goldens = read_goldens(run.golden);
  ASSERT_TRUE(goldens.ok());
  ASSERT_EQ(goldens->size(), 1u);
  EXPECT_EQ((*goldens)[0].name, "day/p.0005.exr");
  EXPECT_EQ((*goldens)[0].variants[0].file, "day/p.0005.exr");
  ASSERT_TRUE(update_goldens({run.golden, "cpu", ""}, run.files).ok());
  EXPECT_EQ(read_goldens(run.golden)->size(), 3u) << "an update keeps them";
}

TEST(Goldens, NothingIsAcceptedThatCannotBeRead) {
  const Rendered run;
  std::ofstream(run.files[1].b, std::ios::trunc) << "no image";
  const auto updated = update_goldens({run.golden, "", ""}, run.files);
  ASSERT_FALSE(updated.ok());
  EXPECT_EQ(updated.error().code, ErrorCode::missing_input);
  EXPECT_FALSE(fs::exists(run.golden));
}

TEST(Goldens, HostileListsAreRefusedWithThePlace) {
  const TemporaryFolder folder;
  const auto list = [](const std::string& variants, const std::string& name = "\"a.exr\"") {
    return "{\"format\": \"skylapse goldens\", \"version\": 1, \"goldens\": [{\"name\": " + name +
           ", \"variants\": " + variants + "}]}";
  };
  const auto one = [&](const std::string& file) {
    return list("[{\"renderer\": \"cpu\", \"file\": " + file + "}]");
  };
  const std::pair<std::string, const char*> cases[] = {
      {"", "it is no JSON"},
      {"[]", "\"format\""},
      {"{\"format\": \"skylapse goldens\", \"version\": 99}", "\"version\""},
      {"{\"format\": \"skylapse goldens\", \"version\": 1, \"goldens\": 3}", "\"goldens\""},
      {list("[]"), "goldens/0: \"variants\""},
      {list("[3]"), "goldens/0/variants/0"},
      {list("[{\"renderer\": \"cpu\"}]"), "\"file\" is missing"},
      {one("3"), "goldens/0/variants/0/file: it is not a text"},
      {one("\"/etc/passwd\""), "no file of a golden"},
      {one("\"../a.exr\""), "no file of a golden"},
      {one("\"a/../../b.exr\""), "no file of a golden"},
      {one("\"golden.json\""), "no file of a golden"},
      {one("\"a\\u0000b\""), "no file of a golden"},
      {list("[{\"renderer\": \"cpu\", \"file\": \"a\"}]", "\"../x\""), "goldens/0/name"},
      {list("[{\"renderer\": \"c\", \"file\": \"a\"}, {\"renderer\": \"c\", \"file\": \"b\"}]"),
       "comes twice"},
      {list("[{\"renderer\": \"c\", \"file\": \"a\"}, {\"renderer\": \"d\", \"file\": \"a\"}]"),
       "belongs to two"},
      {std::string(1 << 20, '['), "it is "}};
  for (const auto& [text, why] : cases) {
    std::ofstream(folder / "golden.json") << text;
    const auto goldens = read_goldens(folder.path().string());
    ASSERT_FALSE(goldens.ok()) << text.substr(0, 200);
    EXPECT_EQ(goldens.error().code, ErrorCode::missing_input);
    EXPECT_NE(goldens.error().message.find(why), std::string::npos) << goldens.error().message;
  }
}

TEST(GoldenContrasts, HoldDifferentScenesAgainstEachOther) {
  const Rendered run({3, 4, 5, 6});
  ASSERT_TRUE(update_goldens({run.golden, "", ""}, run.files).ok());
  fs::copy(run.files[0].b, run.golden + "/again.exr");  // the same moment under another name
  auto goldens = *read_goldens(run.golden);
  Golden again;
  again.name = "again.exr";
  again.variants.emplace_back();
  again.variants[0].file = "again.exr";
  goldens.push_back(again);
  const auto contrasts = golden_contrasts(run.golden, goldens);
  ASSERT_TRUE(contrasts.ok()) << contrasts.error().message;
  std::vector<std::string> pairs;
  for (const GoldenContrast& c : *contrasts) pairs.push_back(c.name_a + " " + c.name_b);
  EXPECT_THAT(pairs, testing::IsSupersetOf({"p.0003.exr p.0004.exr", "p.0004.exr p.0005.exr",
                                            "p.0005.exr p.0006.exr", "p.0003.exr p.0006.exr"}));
  EXPECT_THAT(pairs, testing::Not(testing::Contains("p.0003.exr again.exr")));
}

}  // namespace
}  // namespace skylapse::diff
