// Exit codes and messages as a user meets them.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>

#include "cli/run_program.h"

using namespace skylapse::cli::testing;

namespace {

class Errors : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder();
    std::filesystem::permissions(folder_, std::filesystem::perms::all);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string scene(const std::string& text) { return write_text(folder_ / "s.yaml", text); }
  std::filesystem::path folder_;
};

void expect_mentions(const std::string& text, const std::vector<std::string>& words) {
  for (const auto& word : words)
    EXPECT_NE(text.find(word), std::string::npos) << word << " in:\n" << text;
}

TEST_F(Errors, HelpOfEveryCommandShowsAnExample) {
  for (const char* command : {"render", "plan", "validate", "schema", "sun", "events", "probe",
                              "sheet", "movie", "doctor"}) {
    const auto outcome = run({command, "--help"});
    EXPECT_EQ(outcome.exit_code, 0) << command;
    expect_mentions(outcome.out, {"Example:", "skylapse " + std::string(command)});
  }
}

TEST_F(Errors, WrongCommandLinesExitWithThree) {
  const std::vector<std::vector<std::string>> wrong{
      {},
      {"rendr"},
      {"render"},
      {"sun", "--at", "50"},
      {"sun", "--bogus"},
      {"sun", "--at", "91,0", "--time", "2026-01-01T00:00Z"},
      {"sun", "--at", "50,14", "--time", "2026-01-01T00:00"},
      {"sun", "--at", "50,14", "--time", "2026-01-01T00:00Z", "--algorithm", "spa"},
      {"events", "--at", "50,14", "--zone", "Europe/Praha", "--date", "2026-06-21"},
      {"probe", "--model", "nope", "--batch", "-"}};
  for (const auto& arguments : wrong) {
    const auto outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 3) << ::testing::PrintToString(arguments);
    EXPECT_NE(outcome.err.find("error:"), std::string::npos) << ::testing::PrintToString(arguments);
    EXPECT_EQ(outcome.out, "") << ::testing::PrintToString(arguments);
  }
}

TEST_F(Errors, AWrongLatitudeSaysWhereAndWhatIsAllowed) {
  std::string text = small_scene("{image: \"p.####.png\"}");
  text.replace(text.find("50.0755"), 7, "95.0755");
  const auto outcome = run({"validate", scene(text)});
  EXPECT_EQ(outcome.exit_code, 3);
  expect_mentions(outcome.err, {"s.yaml:1:", "latitude", "90", "^"});
}

TEST_F(Errors, AMissingUnitShowsTheValueWithOne) {
  std::string text = small_scene("{image: \"p.####.png\"}");
  text.replace(text.find("235 m"), 5, "235");
  const auto outcome = run({"validate", scene(text)});
  EXPECT_EQ(outcome.exit_code, 3);
  expect_mentions(outcome.err, {"s.yaml:1:", "unit", "235 m"});
}

TEST_F(Errors, AnUnknownZoneNamesTheNearest) {
  std::string text = small_scene("{image: \"p.####.png\"}");
  text.replace(text.find("Europe/Prague"), 13, "Europe/Pragu");
  const auto outcome = run({"validate", scene(text)});
  EXPECT_EQ(outcome.exit_code, 3);
  expect_mentions(outcome.err, {"s.yaml:2:", "Europe/Prague"});
}

TEST_F(Errors, AllErrorsOfAFileComeInOneRun) {
  const auto outcome =
      run({"validate", scene("location: {latitud: 50, longitude: 214.4 W, height: 235}\n"
                             "time: {zone: Mars/Base, date: 2026-02-30, step: 2 min}\n"
                             "outputs: []\n")});
  EXPECT_EQ(outcome.exit_code, 3);
  size_t errors = 0;
  for (size_t at = outcome.err.find("error:"); at != std::string::npos;
       at = outcome.err.find("error:", at + 1))
    ++errors;
  EXPECT_GE(errors, 5u) << outcome.err;
  expect_mentions(outcome.err, {"latitude"});
}

TEST_F(Errors, AMissingFileExitsWithFour) {
  EXPECT_EQ(run({"render", "no-such.yaml"}).exit_code, 4);
  EXPECT_EQ(run({"sun", "--batch", "no-such.csv"}).exit_code, 4);
  EXPECT_EQ(run({"sheet", "no-such-folder"}).exit_code, 4);
}

TEST_F(Errors, NoFfmpegExitsWithFiveAndSaysWhatToInstall) {
  const auto file = scene(small_scene("{movie: p.mp4}"));
  const auto outcome =
      run({"render", file, "-o", folder_ / "out"}, {.environment = {"PATH=/nonexistent"}});
  EXPECT_EQ(outcome.exit_code, 5);
  expect_mentions(outcome.err, {"ffmpeg", "install"});
}

TEST_F(Errors, NoWritePermissionExitsWithSix) {
  const auto file = scene(small_scene("{image: \"p.####.png\"}"));
  std::filesystem::create_directory(folder_ / "locked");
  std::filesystem::permissions(folder_ / "locked", std::filesystem::perms(0555));
  const auto outcome = run({"render", file, "-o", folder_ / "locked"}, {.in_child = [] {
                             if (geteuid() == 0 && setuid(65534) != 0) _exit(119);
                           }});
  EXPECT_EQ(outcome.exit_code, 6) << outcome.err;
  expect_mentions(outcome.err, {"locked", "ermission"});
}

TEST_F(Errors, AFullDiskExitsWithSixAndKeepsFinishedFrames) {
  // A limit on file size stands for the full disk: small pictures fit, the movie-sized EXR do not.
  const auto file =
      scene(small_scene("{image: \"p.####.png\"}, {image: \"p.####.exr\", compression: none}"));
  const auto outcome = run({"render", file, "-o", folder_ / "out", "--jobs", "1"}, {.in_child = [] {
                             const rlimit limit{60000, 60000};
                             setrlimit(RLIMIT_FSIZE, &limit);
                           }});
  EXPECT_EQ(outcome.exit_code, 6) << outcome.err;
  size_t pictures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "out")) {
    const auto name = entry.path().filename().string();
    EXPECT_TRUE(name.starts_with(".skylapse") || name.ends_with(".png") || name == "manifest.json")
        << "left behind: " << name;
    pictures += name.ends_with(".png");
  }
  EXPECT_GE(pictures, 1u);
}

TEST_F(Errors, HostileFilesAreRefusedClearly) {
  std::string bomb = "a: &a [x,x,x,x,x,x,x,x,x]\n";
  for (char c = 'b'; c < 'l'; ++c)
    bomb += std::string(1, c) + ": &" + c + " [*" + char(c - 1) + ",*" + char(c - 1) + ",*" +
            char(c - 1) + ",*" + char(c - 1) + ",*" + char(c - 1) + "]\n";
  const std::vector<std::string> hostile{
      bomb,
      std::string(100000, '['),
      std::string(1000, '\0'),
      small_scene("{image: \"../../etc/x.####.png\"}"),
      small_scene("{image: \"/etc/x.####.png\"}"),
      small_scene("{image: \"p.####.png\"}",
                  "zone: UTC, date: 2026-06-21, from: '00:00', to: '24:00', step: 1 us"),
      small_scene("{image: \"p.####.png\"}",
                  "zone: UTC, date: 2026-06-21, from: '00:00', to: '24:00', frames: 1000000000")};
  for (const auto& text : hostile) {
    const auto outcome = run({"validate", scene(text)});
    EXPECT_EQ(outcome.exit_code, 3) << text.substr(0, 200) << outcome.err;
    EXPECT_LT(outcome.err.size(), 20000u);
  }
  std::string wide = small_scene("{image: \"p.####.png\"}");
  wide.replace(wide.find("160x90"), 6, "1000000x1000000");
  EXPECT_EQ(run({"validate", scene(wide)}).exit_code, 3);
}

TEST_F(Errors, OverridesObeyTheSameRules) {
  const auto file = scene(small_scene("{image: \"p.####.png\"}"));
  EXPECT_EQ(run({"validate", file, "--set", "air.turbidity=3"}).exit_code, 0);
  const auto outcome =
      run({"validate", file, "--set", "air.turbidty=3", "--set", "location.height=9"});
  EXPECT_EQ(outcome.exit_code, 3);
  expect_mentions(outcome.err, {"--set", "turbidity", "unit"});
}

TEST_F(Errors, AClosedOutputIsAWriteError) {
  const auto outcome = run({"schema"}, {.in_child = [] { close(1); }});
  EXPECT_EQ(outcome.exit_code, 6);
}

}  // namespace
