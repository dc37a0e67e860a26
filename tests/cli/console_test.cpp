// What goes to stdout and what to stderr.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "cli/run_program.h"

using namespace skylapse::cli::testing;

namespace {

class Console : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder();
    scene_ = write_text(folder_ / "s.yaml", small_scene("{image: \"p.####.png\"}"));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
  std::string scene_;
};

const std::string kQueries =
    "id,turbidity,albedo,sun_elevation_deg,view_zenith_deg,relative_azimuth_deg,band,kind\n"
    "007,2,0.1,30,0,0,560,spectral\n\"a \"\"b\",2,0.1,30,0,0,Y,xyz\n";

TEST_F(Console, JsonIsOneDocumentForEveryCommand) {
  const std::string out = folder_ / "out";
  const std::vector<std::vector<std::string>> commands{
      {"render", scene_, "-o", out, "--json"},
      {"render", scene_, "-o", out, "--json", "--dry-run"},
      {"plan", scene_, "--json"},
      {"validate", scene_, scene_, "--json"},
      {"schema", "--json"},
      {"sun", "--at", "50,14", "--time", "2026-06-21T12:00Z", "--json"},
      {"events", "--at", "50,14", "--zone", "Europe/Prague", "--date", "2026-06-21", "--json"},
      {"probe", "--model", "hosek-wilkie", "--batch", "-", "--json"},
      {"sheet", out, "--json"},
      {"movie", out, "--json"},
      {"doctor", "--json"}};
  for (const auto& arguments : commands) {
    const auto outcome = run(arguments, {.input = kQueries});
    EXPECT_EQ(outcome.exit_code, 0) << arguments[0] << outcome.err;
    EXPECT_TRUE(nlohmann::json::accept(outcome.out)) << arguments[0] << "\n" << outcome.out;
  }
}

TEST_F(Console, JsonOfProbeHasTheInputAndTheRadianceOfTheTable) {
  const std::vector<std::string> probe{"probe", "--model", "hosek-wilkie", "--batch", "-"};
  const auto table = run(probe, {.input = kQueries});
  auto with_json = probe;
  with_json.emplace_back("--json");
  const auto rows = nlohmann::json::parse(run(with_json, {.input = kQueries}).out);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["id"], "007");
  EXPECT_EQ(rows[0]["turbidity"], 2.0);
  EXPECT_EQ(rows[1]["id"], "a \"b");
  EXPECT_EQ(rows[1]["band"], "Y");
  const size_t first = table.out.find("spectral,") + 9;
  EXPECT_EQ(rows[0]["radiance"].get<double>(), std::stod(table.out.substr(first)));
}

/// File names are bytes, JSON is UTF-8: such a name once ended the command as an internal error.
TEST_F(Console, JsonCarriesFileNamesThatAreNoText) {
  const std::string scene =
      write_text(folder_ / "s\xff.yaml", small_scene("{image: \"p.####.png\"}"));
  for (const char* command : {"validate", "plan", "render"}) {
    std::vector<std::string> arguments{command, scene, "--json"};
    if (command == std::string("render"))
      arguments.insert(arguments.end(), {"-o", folder_ / "o\xff"});
    const auto outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << command << outcome.err;
    EXPECT_TRUE(nlohmann::json::accept(outcome.out)) << command << "\n" << outcome.out;
  }
}

TEST_F(Console, QuietCommandsSayNothingWhenAllIsWell) {
  const std::string out = folder_ / "out";
  const std::vector<std::vector<std::string>> commands{{"render", scene_, "-o", out, "--quiet"},
                                                       {"render", scene_, "-o", out, "-q"},
                                                       {"validate", scene_, "-q"},
                                                       {"sheet", out, "-q"},
                                                       {"movie", out, "-q"}};
  for (const auto& arguments : commands) {
    const auto outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "") << arguments[0];
    EXPECT_EQ(outcome.out, "") << arguments[0];
  }
}

/// stderr becomes a terminal; what is printed there is read back through `master`.
std::string errors_on_a_terminal(const std::vector<std::string>& environment) {
  const int master = posix_openpt(O_RDWR | O_NOCTTY);
  EXPECT_TRUE(master >= 0 && grantpt(master) == 0 && unlockpt(master) == 0);
  const std::string name = ptsname(master);
  const int held = open(name.c_str(), O_RDWR | O_NOCTTY);  // keeps what the child wrote readable
  run({"sun", "--at", "91,0", "--time", "2026-01-01T00:00Z"},
      {.environment = environment, .in_child = [&] {
         const int terminal = open(name.c_str(), O_RDWR | O_NOCTTY);
         dup2(terminal, 2);
       }});
  std::string text(4096, '\0');
  const ssize_t size = read(master, text.data(), text.size());
  text.resize(size > 0 ? size_t(size) : 0);
  close(held);
  close(master);
  return text;
}

TEST_F(Console, ColourIsForTerminalsAndNoColorTurnsItOff) {
  EXPECT_NE(errors_on_a_terminal({"NO_COLOR="}).find("\033["), std::string::npos);
  const std::string plain = errors_on_a_terminal({"NO_COLOR=1"});
  EXPECT_NE(plain.find("error:"), std::string::npos);
  EXPECT_EQ(plain.find('\033'), std::string::npos) << plain;
  const auto piped = run({"sun", "--at", "91,0", "--time", "2026-01-01T00:00Z"});
  EXPECT_NE(piped.err.find("error:"), std::string::npos);
  EXPECT_EQ(piped.err.find('\033'), std::string::npos) << piped.err;
}

TEST_F(Console, AReaderThatHasGoneIsNoError) {
  const std::vector<std::string> long_table{
      "sun",    "--at", "50,14", "--time", "2026-01-01T00:00Z", "--to", "2026-01-03T00:00Z",
      "--step", "1 min"};
  for (const auto& arguments : {long_table, {"schema"}, {"plan", scene_}, {"--help"}}) {
    const auto outcome = run(arguments, {.in_child = [] {
                               int ends[2];
                               if (pipe(ends) != 0) _exit(119);
                               dup2(ends[1], 1);
                               close(ends[0]);
                               close(ends[1]);
                             }});
    EXPECT_EQ(outcome.exit_code, 0) << arguments[0];
    EXPECT_EQ(outcome.err, "") << arguments[0];
  }
}

TEST_F(Console, AFullDiskBehindStdoutIsAWriteError) {
  for (const auto& arguments :
       std::vector<std::vector<std::string>>{{"schema"}, {"--help"}, {"plan", scene_}}) {
    const auto outcome = run(arguments, {.in_child = [] { dup2(open("/dev/full", O_WRONLY), 1); }});
    EXPECT_EQ(outcome.exit_code, 6) << arguments[0];
    EXPECT_NE(outcome.err.find("standard output"), std::string::npos) << outcome.err;
  }
}

}  // namespace
