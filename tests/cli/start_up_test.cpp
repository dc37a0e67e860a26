// Commands that touch no image must not map the image libraries: that is what keeps their start
// under 50 ms (benchmarks/pipeline/bench_start_up measures it).
#include <gtest/gtest.h>

#include "cli/run_program.h"

using namespace skylapse::cli::testing;

namespace {

std::string libraries_mapped_by(std::vector<std::string> arguments) {
  return run(arguments, {.environment = {"LD_DEBUG=files"}}).err;
}

TEST(StartUp, CommandsWithoutImagesLoadNoImageLibrary) {
  const auto folder = fresh_folder();
  const auto file = write_text(folder / "s.yaml", small_scene("{image: \"p.####.png\"}"));
  const std::vector<std::vector<std::string>> light{
      {"--help"},
      {"sun", "--at", "50,14", "--time", "2026-06-21T12:00Z"},
      {"events", "--at", "50,14", "--zone", "Europe/Prague", "--date", "2026-06-21"},
      {"plan", file},
      {"validate", file}};
  for (const auto& arguments : light) {
    const std::string libraries = libraries_mapped_by(arguments);
    EXPECT_NE(libraries.find("libc.so"), std::string::npos) << "LD_DEBUG printed nothing";
    EXPECT_EQ(libraries.find("libOpenImageIO"), std::string::npos) << arguments[0];
    EXPECT_EQ(libraries.find("libOpenColorIO"), std::string::npos) << arguments[0];
  }
  std::filesystem::remove_all(folder);
}

TEST(StartUp, RenderingLoadsThem) {
  const auto folder = fresh_folder();
  const auto file = write_text(folder / "s.yaml", small_scene("{image: \"p.####.png\"}"));
  EXPECT_NE(libraries_mapped_by({"render", file, "-o", folder / "out", "--frames", "1"})
                .find("libOpenImageIO"),
            std::string::npos);
  std::filesystem::remove_all(folder);
}

}  // namespace
