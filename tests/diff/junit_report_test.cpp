#include <gmock/gmock.h>

#include <cstdlib>

#include "diff/reports.h"
#include "diff/sample_result.h"
#include "support/temporary_folder.h"

namespace skylapse::diff {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

DiffResult with(std::vector<PairResult> pairs) {
  return {"golden", "out", std::move(pairs), {}, Verdict::different, false, 0, 0.25};
}

/// One case of everything, with all that a name can hold.
DiffResult everything() {
  PairResult bad = sample_pair("a<b>&\"c'\x01\x1b\xff\xEF\xBF\xBF]]>.exr");
  fail_measure(bad, "relative.max", 0.94, place_at(180, 40, 182.4, 40.1, "sun's disc"));
  PairResult warned = sample_pair("warned.exr");
  warned.verdict = Verdict::warning;
  warned.findings.push_back({Verdict::warning, "stored-type", "float became half", {}});
  DiffResult result = with({sample_pair("same.exr"), bad, warned, unreadable_pair("cut.exr")});
  result.findings.push_back({Verdict::different, "sequence.missing", "f.0005.exr <missing>", {}});
  return result;
}

TEST(JunitReport, CountsFailuresErrorsAndCases) {
  const std::string xml = junit_report(everything());
  EXPECT_THAT(xml, HasSubstr("tests=\"5\" failures=\"2\" errors=\"1\""));
  EXPECT_THAT(xml, HasSubstr("<failure message=\"different"));
  EXPECT_THAT(xml, HasSubstr("type=\"relative.max\""));
  EXPECT_THAT(xml, HasSubstr("<error message=\"out/cut.exr: the file is cut short\""));
  EXPECT_THAT(xml, HasSubstr("type=\"sequence.missing\""));
}

TEST(JunitReport, WarningsPassWithTheirText) {
  PairResult warned = sample_pair("warned.exr");
  warned.verdict = Verdict::warning;
  warned.findings.push_back({Verdict::warning, "stored-type", "float became half", {}});
  const std::string xml = junit_report(with({warned}));
  EXPECT_THAT(xml, HasSubstr("failures=\"0\""));
  EXPECT_THAT(xml, Not(HasSubstr("<failure")));
  EXPECT_THAT(xml, HasSubstr("<system-out>warning    warned.exr  stored-type: float became half"));
}

TEST(JunitReport, EscapesWhatXmlKnowsAndReplacesWhatItDoesNot) {
  const std::string xml = junit_report(everything());
  EXPECT_THAT(xml, HasSubstr("name=\"a&lt;b&gt;&amp;&quot;c'????]]&gt;.exr\""));
  for (const char c : xml) EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20);
}

TEST(JunitReport, WithoutPairsThereIsTheCaseOfTheWhole) {
  EXPECT_THAT(junit_report(with({})), HasSubstr("tests=\"1\" failures=\"0\""));
}

/// tests/diff_report/junit_report.py names a file and holds it against the schema's rules.
TEST(JunitReport, WritesItsFile) {
  const TemporaryFolder folder;
  const char* named = std::getenv("SKYLAPSE_JUNIT_REPORT");
  const std::string path = named != nullptr ? named : (folder / "junit.xml").string();
  EXPECT_TRUE(write_report(path, junit_report(everything())).ok());
}

}  // namespace
}  // namespace skylapse::diff
