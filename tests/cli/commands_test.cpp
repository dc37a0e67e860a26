// The commands around rendering, run as a user runs them.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/run_program.h"

using namespace skylapse::cli::testing;

namespace {

class Commands : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder();
    scene_ = write_text(folder_ / "s.yaml",
                        small_scene("{image: \"p.####.png\"}, {movie: p.mp4, view: ACES SDR}"));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Outcome render(const std::string& out, std::vector<std::string> more = {},
                 const RunSettings& settings = {}) {
    std::vector<std::string> arguments{"render", scene_, "-o", folder_ / out, "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments, settings);
  }

  /// Names and bytes of what a caller sees; manifests carry times of their own run.
  std::map<std::string, std::string> pictures(const std::string& out) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / out)) {
      const std::string name = entry.path().filename();
      if (name[0] == '.' || name == "manifest.json") continue;
      std::ifstream in(entry.path(), std::ios::binary);
      files[name] = std::string(std::istreambuf_iterator<char>(in), {});
    }
    return files;
  }

  std::filesystem::path folder_;
  std::string scene_;
};

void expect_mentions(const std::string& text, const std::vector<std::string>& words) {
  for (const auto& word : words)
    EXPECT_NE(text.find(word), std::string::npos) << word << " in:\n" << text;
}

TEST_F(Commands, AnUnknownCommandNamesTheNearestAndAll) {
  const auto slip = run({"rendr", scene_});
  EXPECT_EQ(slip.exit_code, 3);
  expect_mentions(slip.err, {"'rendr' is no command", "did you mean 'render'?", "doctor"});
  const auto far = run({"foo"});
  EXPECT_EQ(far.exit_code, 3);
  expect_mentions(far.err, {"'foo' is no command", "render, plan, validate"});
  EXPECT_EQ(far.err.find("did you mean"), std::string::npos) << far.err;
}

TEST_F(Commands, AnUnknownOptionNamesTheNearest) {
  for (const char* option : {"--ouptut", "--ouptut=x"}) {
    const auto outcome = run({"render", scene_, option});
    EXPECT_EQ(outcome.exit_code, 3);
    expect_mentions(outcome.err, {"option '--ouptut", "did you mean '--output'?"});
  }
}

TEST_F(Commands, AnEmptyOutputNameIsRefused) {
  for (const char* command : {"render", "plan", "sheet", "movie"}) {
    const auto outcome = run({command, scene_, "-o", ""}, {.folder = folder_});
    EXPECT_EQ(outcome.exit_code, 3) << command;
    expect_mentions(outcome.err, {"--output", "empty"});
  }
  EXPECT_EQ(pictures("").size(), 1u) << "only the scene file";
}

TEST_F(Commands, ADryRunPrintsThePlanAndWritesNothing) {
  const auto dry = run({"render", scene_, "-o", folder_ / "out", "--dry-run"});
  EXPECT_EQ(dry.exit_code, 0) << dry.err;
  EXPECT_EQ(dry.out, run({"plan", scene_, "-o", folder_ / "out"}).out);
  EXPECT_NE(dry.out, "");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(Commands, DoctorFindsThisMachineWell) {
  const auto outcome = run({"doctor"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
  EXPECT_EQ(outcome.out.find("FAIL"), std::string::npos) << outcome.out;
  const auto checks = nlohmann::json::parse(run({"doctor", "--json"}).out);
  EXPECT_GE(checks.size(), 8u);
  for (const auto& check : checks) EXPECT_TRUE(check["ok"]) << check;
}

TEST_F(Commands, SheetAndMovieAreMadeFromWhatARenderLeft) {
  ASSERT_EQ(render("out").exit_code, 0);
  const std::string out = folder_ / "out";
  EXPECT_EQ(run({"sheet", out}).exit_code, 0);
  EXPECT_GT(std::filesystem::file_size(folder_ / "out" / "contact-sheet.jpg"), 1000u);
  const std::string png = folder_ / "sheet.PNG";
  const auto sheet = run({"sheet", out, "-o", png, "--columns", "3", "--json"});
  ASSERT_EQ(sheet.exit_code, 0) << sheet.err;
  EXPECT_EQ(nlohmann::json::parse(sheet.out)["file"], png);
  EXPECT_EQ(nlohmann::json::parse(sheet.out)["frames"], 6);
  std::string magic(4, '\0');
  std::ifstream(png, std::ios::binary).read(magic.data(), 4);
  EXPECT_EQ(magic, "\x89PNG");
  const std::string file = folder_ / "day.mp4";
  const auto movie = run({"movie", out, "-o", file, "--fps", "12", "--json"});
  ASSERT_EQ(movie.exit_code, 0) << movie.err;
  EXPECT_EQ(nlohmann::json::parse(movie.out)["frames"], 6);
  std::FILE* probe = popen(("ffprobe -v error -count_frames -show_entries "
                            "stream=width,height,r_frame_rate,nb_read_frames -of csv=p=0 " +
                            file)
                               .c_str(),
                           "r");
  ASSERT_NE(probe, nullptr);
  std::array<char, 200> line{};
  EXPECT_NE(std::fgets(line.data(), int(line.size()), probe), nullptr);
  pclose(probe);
  EXPECT_EQ(std::string(line.data()), "160,90,12/1,6\n");
}

TEST_F(Commands, OutputsOfUnknownKindAreRefusedBeforeFramesAreRead) {
  std::filesystem::create_directory(folder_ / "broken");
  write_text(folder_ / "broken" / "p.1.png", "no picture: reading it would be the first error");
  const std::string broken = folder_ / "broken";
  for (const char* name : {"x.bmp", "x", "x.mp4"}) {
    const auto outcome = run({"sheet", broken, "-o", folder_ / name});
    EXPECT_EQ(outcome.exit_code, 3) << name;
    expect_mentions(outcome.err, {name, ".png, .jpg, .jpeg"});
  }
  for (const char* name : {"x.avi", "x", "x.png"}) {
    const auto outcome = run({"movie", broken, "-o", folder_ / name});
    EXPECT_EQ(outcome.exit_code, 3) << name;
    expect_mentions(outcome.err, {name, ".mp4, .mov, .mkv, .webm"});
  }
}

TEST_F(Commands, SlurmVariablesAreTheShard) {
  ASSERT_EQ(render("whole").exit_code, 0);
  for (const int id : {0, 2, 4}) {  // --array=0-4:2
    const auto outcome = render(
        "parts", {},
        {.environment = {"SLURM_ARRAY_TASK_ID=" + std::to_string(id), "SLURM_ARRAY_TASK_MIN=0",
                         "SLURM_ARRAY_TASK_STEP=2", "SLURM_ARRAY_TASK_COUNT=3"}});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    size_t frames = 0;
    for (const auto& [name, bytes] : pictures("parts")) frames += name.ends_with(".png");
    EXPECT_EQ(frames, size_t(id) + 2) << "two of six frames a task";
  }
  ASSERT_EQ(render("parts").exit_code, 0) << "the movie needs all frames";
  EXPECT_EQ(pictures("parts"), pictures("whole"));
  const auto wrong =
      render("wrong", {},
             {.environment = {"SLURM_ARRAY_TASK_ID=3", "SLURM_ARRAY_TASK_MIN=0",
                              "SLURM_ARRAY_TASK_STEP=2", "SLURM_ARRAY_TASK_COUNT=3"}});
  EXPECT_EQ(wrong.exit_code, 3);
  expect_mentions(wrong.err, {"SLURM_ARRAY_TASK_ID=3", "SLURM_ARRAY_TASK_STEP=2", "--shard"});
}

TEST_F(Commands, TwoShardsAtOnceInOneFolderEndAsOneRun) {
  ASSERT_EQ(render("whole").exit_code, 0);
  Outcome first, second;
  std::thread other([&] { first = render("both", {"--shard", "1/2"}); });
  second = render("both", {"--shard", "2/2"});
  other.join();
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(second.exit_code, 0) << second.err;
  size_t frames = 0;
  for (const auto& [name, bytes] : pictures("both")) frames += name.ends_with(".png");
  EXPECT_EQ(frames, 6u);
  ASSERT_EQ(render("both").exit_code, 0);
  EXPECT_EQ(pictures("both"), pictures("whole"));
}

TEST_F(Commands, TwoIdenticalProcessesAtOnceBothEndWell) {
  ASSERT_EQ(render("whole").exit_code, 0);
  Outcome first, second;
  std::thread other([&] { first = render("twice"); });
  second = render("twice");
  other.join();
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(pictures("twice"), pictures("whole"));
}

}  // namespace
