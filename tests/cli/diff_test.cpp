// What a caller of `skylapse diff` sees: exit codes, lines, reports, goldens.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/run_program.h"

using namespace skylapse::cli::testing;
namespace fs = std::filesystem;

namespace {

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Two renders of one small sequence, rendered once for all tests: `a`, and `late`, ten minutes on.
class Diff : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fresh_folder();
    const auto render = [](const std::string& name, const std::string& from,
                           const std::string& to) {
      const auto scene =
          write_text(folder_ / (name + ".yaml"),
                     small_scene("{image: \"f.####.exr\"}, {image: \"f.####.png\", view: ACES SDR}",
                                 "zone: Europe/Prague, date: 2026-06-21, from: " + from +
                                     ", to: " + to + ", step: 10 min"));
      const auto outcome = run({"render", scene, "--output", folder_ / name, "--quiet"});
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    };
    render("a", "'05:30'", "'05:50'");
    render("late", "'05:40'", "'06:00'");
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }
  void SetUp() override {
    scratch_ = folder_ / "scratch";
    fs::create_directories(scratch_);
  }
  void TearDown() override { fs::remove_all(scratch_); }

  static fs::path frame(int i) { return folder_ / "a" / ("f.000" + std::to_string(i) + ".exr"); }
  static Outcome diff(const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"diff"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return run(all);
  }

  static fs::path folder_;
  fs::path scratch_;
};
fs::path Diff::folder_;

TEST_F(Diff, TheSameFileIsTheSame) {
  const auto outcome = diff({frame(1), frame(1)});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(holds(outcome.out, "same       f.0001.exr")) << outcome.out;
}

TEST_F(Diff, AnotherMomentIsDifferentAndSaysWhy) {
  const auto outcome = diff({frame(1), frame(2)});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(holds(outcome.out, "different")) << outcome.out;
  EXPECT_TRUE(holds(outcome.out, "metadata.")) << outcome.out;
}

TEST_F(Diff, ExactSeesTheSmallestStepOfASample) {
  // A change of one sample that is no number as a share of the pixel's light.
  const auto a = scratch_ / "a.pfm", b = scratch_ / "b.pfm";
  const auto write = [](const fs::path& file, float faint) {
    std::ofstream out(file, std::ios::binary);
    out << "PF\n1 1\n-1.0\n";
    for (const float v : {1e30F, 1.0F, faint}) out.write(reinterpret_cast<const char*>(&v), 4);
  };
  write(a, 1e-30F), write(b, 2e-30F);
  EXPECT_EQ(diff({a, b, "--profile", "exact"}).exit_code, 2);
  EXPECT_EQ(diff({a, a, "--profile", "exact"}).exit_code, 0);
  EXPECT_EQ(diff({a, b}).exit_code, 0);
}

TEST_F(Diff, TheCameraOfAFileWinsOverTheCommandLine) {
  const auto outcome = diff({frame(1), frame(1), "--projection", "cube"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
}

TEST_F(Diff, FoldersAndManifestsAreComparedFrameByFrame) {
  for (const char* end : {"", "/manifest.json"}) {
    const std::string a = (folder_ / "a").string() + end, late = (folder_ / "late").string() + end;
    const auto same = diff({a, a});
    EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
    EXPECT_TRUE(holds(same.out, "6 pairs: 6 same")) << same.out;
    const auto other = diff({a, late});
    EXPECT_EQ(other.exit_code, 2) << other.out;
    EXPECT_TRUE(holds(other.out, "6 different")) << other.out;
    EXPECT_TRUE(holds(other.out, "sequence.order")) << other.out;
  }
}

TEST_F(Diff, AMissingFrameFailsAndAnExtraOneToo) {
  fs::create_directories(scratch_ / "b");
  fs::copy_file(frame(1), scratch_ / "b" / "f.0001.exr");
  fs::create_directories(scratch_ / "c");
  for (int i = 1; i <= 2; ++i)
    fs::copy_file(frame(i), scratch_ / "c" / ("f.000" + std::to_string(i) + ".exr"));
  const auto missing = diff({scratch_ / "c", scratch_ / "b"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_TRUE(holds(missing.out, "sequence.missing")) << missing.out;
  const auto extra = diff({scratch_ / "b", scratch_ / "c"});
  EXPECT_EQ(extra.exit_code, 2);
  EXPECT_TRUE(holds(extra.out, "sequence.extra")) << extra.out;
  EXPECT_EQ(diff({scratch_ / "b", scratch_ / "c", "--ignore", "f.0002.*"}).exit_code, 0);
}

TEST_F(Diff, UnreadableFilesAreExitCode4) {
  const auto truncated = scratch_ / "cut.exr";
  fs::copy_file(frame(1), truncated);
  fs::resize_file(truncated, fs::file_size(truncated) / 2);
  const auto empty = write_text(scratch_ / "empty.exr", "");
  const auto words = write_text(scratch_ / "words.exr", "no picture\n");
  for (const auto& bad : {truncated, empty, words, scratch_ / "none.exr"}) {
    const auto outcome = diff({frame(1), bad});
    EXPECT_EQ(outcome.exit_code, 4) << bad << outcome.out << outcome.err;
    EXPECT_TRUE(holds(outcome.err, "error:")) << outcome.err;
  }
}

TEST_F(Diff, WrongArgumentsAreExitCode3WithWhatIsAllowed) {
  const std::string a = frame(1);
  const struct {
    std::vector<std::string> arguments;
    std::string says;
  } cases[] = {
      {{}, "skylapse diff A B"},
      {{a}, "B is missing"},
      {{a, folder_ / "a"}, "folder"},
      {{a, a, "--profile", "cross-rendrer"}, "did you mean cross-renderer?"},
      {{a, a, "--limit", "relative.rsm=1"}, "did you mean relative.rms?"},
      {{a, a, "--limit", "relative.rms=-1"}, "a number from 0 up"},
      {{a, a, "--limit", "relative.rms"}, "NAME=FAIL"},
      {{a, a, "--check", "nan=never"}, "allowed: fail, warn, ignore"},
      {{a, a, "--fail-above", "much"}, "a number from 0 up"},
      {{a, a, "--fail-percent", "5"}, "--fail-above"},
      {{a, a, "--fail-above", "1", "--fail-percent", "101"}, "allowed: 0 to 100"},
      {{a, a, "--fail-above", "1", "--metric", "beauty"}, "allowed: relative, absolute, flip"},
      {{a, a, "--projection", "perspectiv"}, "allowed: lat-long"},
      {{a, a, "--sun", "120"}, "AZIMUTH,ELEVATION"},
      {{a, a, "--flip-exposures", "2,1,3"}, "START,STOP,COUNT"},
      {{a, a, "--flip-ppd", "0"}, "allowed: 1 to 1000"},
      {{a, a, "--psnr-peak", "0"}, "above 0"},
      {{a, a, "--jobs", "-1"}, "allowed: 1 to 1024"},
      {{a, a, "--golden-dir", folder_}, "takes the place of A"},
      {{a, a, "--update-golden"}, "--golden-dir"},
      {{a, a, "--self-check"}, "--golden-dir"},
      {{a, "--self-check", "--golden-dir", folder_}, "with each other alone"},
      {{a, a, "--fail-above", "1", "--limit", "relative.max=1"}, "takes the place of a profile"},
      {{a, a, "--limit", "display.max=1%"}, "no percent"},
      {{a, a, "--limit", "relative.max=1%,5%"}, "above the failing one"},
      {{a, a, "--heatmap", "x.jpg"}, ".png or .exr"},
      {{a, a, "--prune"}, "belongs to --update-golden"},
      {{a, a, "--htm", "x"}, "did you mean '--html'?"},
      {{a, a, "--rules", write_text(scratch_ / "r.yaml", "limts: {}\n")}, "r.yaml:1:1"},
  };
  for (const auto& c : cases) {
    const auto outcome = diff(c.arguments);
    EXPECT_EQ(outcome.exit_code, 3) << outcome.out << outcome.err;
    EXPECT_TRUE(holds(outcome.err, c.says)) << c.says << "\n" << outcome.err;
  }
}

TEST_F(Diff, LimitsOfTheCommandLineDecide) {
  const std::string a = frame(1), b = frame(2);
  std::vector<std::string> lenient{a, b, "--profile", "cross-model", "--no-flip"};
  for (const char* check : {"metadata.sun", "metadata.time"})
    lenient.insert(lenient.end(), {"--check", std::string(check) + "=ignore"});
  lenient.insert(lenient.end(), {"--limit", "sun.shift_deg=off", "--limit", "sun.flux=off"});
  EXPECT_LE(diff(lenient).exit_code, 1) << diff(lenient).out;
  lenient.insert(lenient.end(), {"--limit", "relative.rms=0.0001"});
  EXPECT_EQ(diff(lenient).exit_code, 2);
}

TEST_F(Diff, OneLimitMayTakeThePlaceOfAProfile) {
  std::vector<std::string> base{
      frame(1), frame(2), "--check", "metadata.sun=ignore", "--check", "metadata.time=ignore"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), base.begin(), base.end());
    return diff(more).exit_code;
  };
  EXPECT_EQ(with({"--fail-above", "2"}), 0) << "no error is larger than 2";
  EXPECT_EQ(with({"--fail-above", "0.1 %"}), 2);
  EXPECT_EQ(with({"--fail-above", "0.1 %", "--fail-percent", "100"}), 0);
  EXPECT_EQ(with({"--fail-above", "2", "--warn-above", "0.1 %"}), 1);
  EXPECT_EQ(with({"--fail-above", "1e9", "--metric", "absolute"}), 0);
  EXPECT_EQ(with({"--fail-above", "0", "--metric", "absolute"}), 2);
  EXPECT_EQ(with({"--fail-above", "1", "--metric", "flip"}), 0);
}

TEST_F(Diff, ReportsAreWritten) {
  const auto outcome =
      diff({folder_ / "a", folder_ / "late", "--json", scratch_ / "r.json", "--junit",
            scratch_ / "r.xml", "--heatmap", scratch_ / "heat.png", "--html", scratch_ / "page"});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  const auto json = nlohmann::json::parse(text_of(scratch_ / "r.json"));
  EXPECT_EQ(json.at("pairs").size(), 6u);
  EXPECT_TRUE(holds(text_of(scratch_ / "r.xml"), "<testsuite"));
  EXPECT_TRUE(holds(text_of(scratch_ / "heat.png").substr(0, 4), "PNG"));
  EXPECT_TRUE(holds(text_of(scratch_ / "page" / "index.html"), "</html>"));
  const auto to_stdout = diff({frame(1), frame(1), "--json", "-"});
  EXPECT_EQ(nlohmann::json::parse(to_stdout.out).at("pairs").size(), 1u);
}

TEST_F(Diff, AReportThatCannotBeWrittenIsExitCode6AndTheOthersAreThere) {
  const auto file = write_text(scratch_ / "file", "no folder\n");
  const auto outcome =
      diff({frame(1), frame(1), "--json", file / "r.json", "--junit", scratch_ / "r.xml"});
  EXPECT_EQ(outcome.exit_code, 6) << outcome.err;
  EXPECT_TRUE(fs::exists(scratch_ / "r.xml"));
  EXPECT_EQ(diff({frame(1), frame(2), "--json", file / "r.json"}).exit_code, 2);
}

TEST_F(Diff, GoldensAreAcceptedAndHeldAgainst) {
  const auto goldens = scratch_ / "goldens";
  const auto accepted =
      diff({folder_ / "a", "--golden-dir", goldens, "--update-golden", "--note", "first"});
  ASSERT_EQ(accepted.exit_code, 0) << accepted.out << accepted.err;
  EXPECT_TRUE(holds(text_of(goldens / "golden.json"), "first"));
  EXPECT_EQ(diff({folder_ / "a", "--golden-dir", goldens}).exit_code, 0);
  const auto late = diff({folder_ / "late", "--golden-dir", goldens});
  EXPECT_EQ(late.exit_code, 2) << late.out;
  const auto check = diff({"--self-check", "--golden-dir", goldens});
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  EXPECT_TRUE(holds(check.out, "0 not told apart")) << check.out;
  // Another renderer's pictures join them: then both pass.
  ASSERT_EQ(
      diff({folder_ / "late", "--golden-dir", goldens, "--update-golden", "--renderer", "another"})
          .exit_code,
      0);
  EXPECT_EQ(diff({folder_ / "late", "--golden-dir", goldens, "--renderer", "another"}).exit_code,
            0);
  EXPECT_EQ(diff({folder_ / "a", "--golden-dir", goldens}).exit_code, 0);
  EXPECT_EQ(diff({folder_ / "a", "--golden-dir", goldens, "--renderer", "another"}).exit_code, 2)
      << "another renderer's golden is no excuse";
  EXPECT_EQ(diff({folder_ / "a", "--golden-dir", goldens, "--renderer", "a third"}).exit_code, 0);
}

TEST_F(Diff, AComparisonOfNothingDoesNotPass) {
  const auto rules = write_text(scratch_ / "r.yaml", "paths: [{path: \"**\", ignore: true}]\n");
  EXPECT_EQ(diff({folder_ / "a", folder_ / "late", "--rules", rules}).exit_code, 4);
  EXPECT_EQ(diff({folder_ / "a", folder_ / "late", "--ignore", "**"}).exit_code, 4);
}

TEST_F(Diff, GoldensOfScenesThatAreGoneArePruned) {
  const auto goldens = scratch_ / "goldens";
  fs::create_directories(goldens);
  write_text(goldens / "README.md", "goldens\n");
  ASSERT_EQ(diff({folder_ / "a", "--golden-dir", goldens, "--update-golden"}).exit_code, 0);
  fs::create_directories(scratch_ / "b");
  fs::copy_file(frame(1), scratch_ / "b" / "f.0001.exr");
  EXPECT_EQ(diff({scratch_ / "b", "--golden-dir", goldens}).exit_code, 2);
  EXPECT_EQ(diff({scratch_ / "b", "--golden-dir", goldens, "--update-golden", "--prune"}).exit_code,
            0);
  EXPECT_EQ(diff({scratch_ / "b", "--golden-dir", goldens}).exit_code, 0);
}

TEST_F(Diff, LimitsThatLetEverythingPassFailTheSelfCheck) {
  const auto goldens = scratch_ / "goldens";
  ASSERT_EQ(diff({folder_ / "a", "--golden-dir", goldens, "--update-golden"}).exit_code, 0);
  const auto check = diff({"--self-check", "--golden-dir", goldens, "--fail-above", "2"});
  EXPECT_EQ(check.exit_code, 2) << check.out;
  EXPECT_TRUE(holds(check.out, "self-check")) << check.out;
}

}  // namespace
