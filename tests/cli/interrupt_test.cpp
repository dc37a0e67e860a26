// Killed at random moments, forty times: only whole frames, and the resumed job ends
// byte-identical.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <thread>

#include "cli/run_program.h"
#include "core/sha256.h"

using namespace skylapse::cli::testing;

namespace {

std::map<std::string, std::string> visible_files(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const auto name = std::filesystem::relative(entry.path(), folder).string();
    if (!entry.is_regular_file() || name.starts_with(".") || name == "manifest.json") continue;
    std::ifstream in(entry.path(), std::ios::binary);
    std::ostringstream bytes;
    bytes << in.rdbuf();
    files[name] = skylapse::sha256_hex(bytes.str());
  }
  return files;
}

class Interrupts : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder();
    scene_ =
        write_text(folder_ / "s.yaml",
                   small_scene("{image: \"p.####.png\", view: ACES SDR}, {image: \"p.####.exr\", "
                               "type: half}, {movie: p.mp4, view: ACES SDR}",
                               "zone: Europe/Prague, date: 2026-06-21, from: sunrise, to: "
                               "sunrise + 115 min, step: 5 min"));
    const auto outcome = run({"render", scene_, "-o", folder_ / "whole", "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    whole_ = visible_files(folder_ / "whole");
    ASSERT_EQ(whole_.size(), 24u + 24u + 1u);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Every visible file is one of the finished job's, byte for byte.
  void expect_only_whole_files(const std::filesystem::path& out) {
    for (const auto& [name, hash] : visible_files(out)) {
      ASSERT_TRUE(whole_.contains(name)) << name;
      ASSERT_EQ(hash, whole_.at(name)) << name;
    }
  }

  std::filesystem::path folder_;
  std::string scene_;
  std::map<std::string, std::string> whole_;
};

TEST_F(Interrupts, KilledAtRandomMomentsTheJobEndsByteIdentical) {
  std::mt19937 random(20260621);
  std::uniform_int_distribution<int> delay_ms(5, 900);
  const auto out = folder_ / "out";
  for (int i = 0; i < 40; ++i) {
    const int signal = std::array{SIGKILL, SIGTERM, SIGINT}[size_t(i % 3)];
    const int delay = delay_ms(random);
    const auto outcome =
        run({"render", scene_, "-o", out, "-q"}, {.while_running = [&](pid_t child) {
              std::this_thread::sleep_for(std::chrono::milliseconds(delay));
              kill(child, signal);
            }});
    // Done before the signal came, killed, or stopped by it: early signals meet the default action.
    const std::vector<int> allowed{0, 128 + signal};
    EXPECT_NE(std::find(allowed.begin(), allowed.end(), outcome.exit_code), allowed.end())
        << outcome.exit_code << outcome.err;
    expect_only_whole_files(out);
    if (outcome.exit_code == 0) std::filesystem::remove_all(out);
  }
  const auto last = run({"render", scene_, "-o", out, "-q"});
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_EQ(visible_files(out), whole_);
  for (const auto& entry : std::filesystem::directory_iterator(out))
    EXPECT_FALSE(entry.path().filename().string().ends_with(".tmp")) << entry.path();
}

TEST_F(Interrupts, TheSignalNamesTheExitCode) {
  for (const auto& [signal, code] : {std::pair(SIGINT, 130), std::pair(SIGTERM, 143)}) {
    const auto out = folder_ / ("out" + std::to_string(signal));
    const auto outcome =
        run({"render", scene_, "-o", out, "--jobs", "1"}, {.while_running = [&](pid_t child) {
              // After the first frame the handlers stand and work is going on.
              for (int i = 0; i < 2000 && visible_files(out).empty(); ++i)
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
              kill(child, signal);
            }});
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_NE(outcome.err.find("finished frames are kept"), std::string::npos);
    expect_only_whole_files(out);
    EXPECT_TRUE(std::filesystem::exists(out / "manifest.json"));
  }
}

}  // namespace
