#include <gmock/gmock.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "diff/reports.h"
#include "diff/sample_result.h"
#include "support/temporary_folder.h"

namespace skylapse::diff {
namespace {

using Json = nlohmann::json;

DiffResult everything() {
  DiffResult result{"golden", "out", {}, {}, Verdict::different, true, 0, 1.5};
  PairResult bad = sample_pair("site/f.0001.exr");
  fail_measure(bad, "relative.max", std::numeric_limits<double>::infinity(),
               place_at(1, 2, 90, 45, "zenith"));
  measure_of(bad, "flip.mean").value = std::numeric_limits<double>::quiet_NaN();
  bad.view.sun = enu_direction(182.4 * deg, 40.1 * deg);
  result.pairs = {sample_pair("a.exr"), bad, unreadable_pair("\xff\"<.exr")};
  result.findings.push_back(
      {Verdict::different, "sequence.missing", "f.0005.exr is missing in B", {}});
  return result;
}

void collect_keys(const Json& j, std::set<std::string>& keys) {
  if (j.is_object())
    for (const auto& [key, value] : j.items()) keys.insert(key), collect_keys(value, keys);
  if (j.is_array())
    for (const Json& value : j) collect_keys(value, keys);
}

TEST(JsonReport, HoldsVerdictsMeasuresAndPlaces) {
  const Json j = Json::parse(json_report(everything()));
  EXPECT_EQ(j["format"], "skylapse-diff");
  EXPECT_EQ(j["exit_code"], 4);
  EXPECT_EQ(j["counts"], (Json{{"same", 1}, {"warning", 0}, {"different", 1}, {"unreadable", 1}}));
  const Json& bad = j["pairs"][1];
  EXPECT_EQ(bad["verdict"], "different");
  EXPECT_EQ(bad["measures"][0]["name"], "relative.max");
  EXPECT_EQ(bad["measures"][0]["place"]["region"], "zenith");
  EXPECT_NEAR(bad["sun"]["azimuth_deg"].get<double>(), 182.4, 1e-9);
  EXPECT_EQ(j["findings"][0]["check"], "sequence.missing");
}

TEST(JsonReport, NumbersThatAreNotFiniteAreStringsAndMissingOnesNull) {
  const Json bad = Json::parse(json_report(everything()))["pairs"][1];
  EXPECT_EQ(bad["measures"][0]["value"], "Infinity");
  EXPECT_EQ(bad["measures"][3]["value"], "NaN");
  EXPECT_TRUE(bad["measures"][3]["fail_limit"].is_null());
}

TEST(JsonReport, NamesOfAnyBytesBecomeText) {
  const Json cut = Json::parse(json_report(everything()))["pairs"][2];
  EXPECT_EQ(cut["name"], "?\"<.exr");
  EXPECT_EQ(cut["error"]["hint"], "render it again");
}

TEST(JsonReport, IsValidWithoutPairs) {
  const Json j = Json::parse(json_report({}));
  EXPECT_TRUE(j["pairs"].is_array());
  EXPECT_TRUE(j["pairs"].empty());
  EXPECT_EQ(j["exit_code"], 0);
}

TEST(JsonReport, EveryKeyIsDocumented) {
  std::ifstream file(SKYLAPSE_SOURCE_DIR "/docs/ci.md");
  std::stringstream text;
  text << file.rdbuf();
  std::set<std::string> keys;
  collect_keys(Json::parse(json_report(everything())), keys);
  ASSERT_GT(keys.size(), 30u);
  for (const std::string& key : keys)
    EXPECT_THAT(text.str(), ::testing::HasSubstr("`" + key + "`")) << "docs/ci.md";
}

TEST(WriteReport, WritesWholeFilesAndNamesThePathThatCannotBeWritten) {
  const TemporaryFolder folder;
  const auto path = (folder.path() / "sub" / "report.json").string();
  ASSERT_TRUE(write_report(path, "text").ok());
  std::ifstream file(path);
  std::string read;
  file >> read;
  EXPECT_EQ(read, "text");
  const auto failed = write_report((folder.path() / "sub").string(), "text");
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().code, ErrorCode::write_failed);
}

}  // namespace
}  // namespace skylapse::diff
