// What a caller of `skylapse study` sees when something is wrong, and after a signal.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/run_program.h"

using namespace skylapse::cli::testing;

namespace {

class Study : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder();
    scene_ = write_text(folder_ / "s.yaml", small_scene("{image: \"p.####.exr\"}"));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
  std::string scene_;
};

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(Study, BadInputIsRefusedBeforeAnythingIsTraced) {
  const struct {
    std::vector<std::string> arguments;
    int exit_code;
    std::string says;
  } cases[] = {
      {{scene_, "--scenes", "noon"}, 3, "belongs to the scenes that come with the program"},
      {{"--scenes", "nowhere"}, 3, "allowed: noon, low_sun, twilight, airliner"},
      {{"--frames", "1"}, 3, "belongs to a config"},
      {{"--repeats", "0"}, 3, "allowed: 1 to 100"},
      {{"--noise", "0"}, 3, "allowed: 0.01 to 20 percent"},
      {{"--noise", "nan"}, 3, "allowed: 0.01 to 20 percent"},
      {{(folder_ / "none.yaml").string()}, 4, "there is no such file"},
      {{write_text(folder_ / "bad.yaml", "camera: {size: 0x0}\n")}, 3, "bad.yaml:1:16"},
  };
  for (const auto& c : cases) {
    std::vector<std::string> arguments{"study", "--quick", "--output", folder_ / "out"};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    const auto outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, c.exit_code) << outcome.err;
    EXPECT_TRUE(holds(outcome.err, c.says)) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  }
}

TEST_F(Study, OfAUsersSceneGivesTableFiguresAndReport) {
  const auto outcome = run({"study", scene_, "--quick", "--noise", "20", "--repeats", "1",
                            "--frames", "1", "--json", "--output", folder_ / "out"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto summary = nlohmann::json::parse(outcome.out);
  EXPECT_GT(summary["scenes"].at(0)["rungs"].get<int>(), 10);
  EXPECT_FALSE(summary["scenes"][0]["front"].empty());
  for (const char* file : {"study.csv", "report.html"})
    EXPECT_GT(std::filesystem::file_size(folder_ / "out" / file), 1000U) << file;
  EXPECT_FALSE(std::filesystem::is_empty(folder_ / "out" / "figures"));
}

TEST_F(Study, ASignalEndsItWithItsExitCodeAndLeavesNoHalfReport) {
  const auto outcome = run({"study", scene_, "--quick", "--output", folder_ / "out"},
                           {.while_running = [](pid_t program) {
                             std::this_thread::sleep_for(std::chrono::milliseconds(1200));
                             kill(program, SIGTERM);
                           }});
  EXPECT_EQ(outcome.exit_code, 143) << outcome.err;
  EXPECT_TRUE(holds(outcome.err, "interrupted")) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "report.html"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "study.csv"));
}

}  // namespace
