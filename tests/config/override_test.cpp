#include <gtest/gtest.h>

#include "config/job_text.h"

namespace skylapse::config {
namespace {

using test::error_of;
using test::kSmallJob;

JobConfig job_of(const std::vector<Override>& overrides, const std::string& text = kSmallJob) {
  auto job = parse_job(text, "job.yaml", overrides);
  EXPECT_TRUE(job.ok()) << error_of(text, overrides);
  return job.ok() ? *job : JobConfig{};
}

TEST(Override, ReplacesAddsAndReachesIntoLists) {
  const JobConfig job = job_of({{"camera.size", "64x36"},
                                {"air.turbidity", "[2, 4]"},
                                {"outputs.0.type", "u16"},
                                {"location.name", "Praha, město"},
                                {"title", "\"a: b\""}},
                               kSmallJob);
  EXPECT_EQ(job.cameras[0].camera.width, 64);
  EXPECT_EQ(job.air.turbidity.size(), 2u);
  EXPECT_EQ(std::get<ImageOutput>(job.outputs[0]).sample_type, output::SampleType::u16);
  EXPECT_EQ(job.title, "a: b");
}

TEST(Override, SpansPointIntoTheCommandLine) {
  const JobConfig job = job_of({{"air.turbidity", "4"}});
  EXPECT_EQ(job.air.turbidity[0].span.file, "--set air.turbidity");
  EXPECT_EQ(job.air.turbidity[0].span.column, 15);
  EXPECT_EQ(job.air.turbidity[0].span.source_line, "air.turbidity=4");
}

TEST(Override, ObeysTheRulesOfTheFile) {
  EXPECT_EQ(error_of(kSmallJob, {{"air.turbidity", "12"}}),
            "--set air.turbidity:1 [12] air.turbidity = 12 is out of range | allowed: 1 to 10");
  EXPECT_EQ(error_of(kSmallJob, {{"air.turbidty", "3"}}),
            "--set air.turbidty:1 [turbidty] the key \"turbidty\" is not known in air | did you "
            "mean turbidity?");
  EXPECT_EQ(error_of(kSmallJob, {{"location.height", "235"}}),
            "--set location.height:1 [235] location.height: 235 has no unit | write 235 m; allowed "
            "units: m, km, ft");
  EXPECT_EQ(error_of(kSmallJob, {{"outputs.3.type", "half"}}),
            "--set outputs.3.type:1 [3] the list has no item 3 | allowed: 0 to 0");
  EXPECT_EQ(error_of(kSmallJob, {{"outputs.first.type", "half"}}),
            "--set outputs.first.type:1 [first] the list has no item first | allowed: 0 to 0");
  EXPECT_EQ(error_of(kSmallJob, {{"time.zone.name", "x"}}),
            "--set time.zone.name:1 [name] \"name\" names a part of a single value | set the whole "
            "value");
  EXPECT_EQ(error_of(kSmallJob, {{"camera.fov", ""}}),
            "--set camera.fov:1 [fov] camera.fov has no value | such as 75 deg");
  EXPECT_EQ(error_of(kSmallJob, {{"camera..fov", "3 deg"}}),
            "--set camera..fov:1 [.] a key is missing in \"camera..fov\" | did you mean "
            "camera.fov=...?");
  EXPECT_EQ(error_of(kSmallJob, {{".title", "x"}}),
            "--set .title:1 [.] a key is missing in \".title\" | did you mean title=...?");
  EXPECT_EQ(error_of(kSmallJob, {{"title.", "x"}}),
            "--set title.:1 [=] a key is missing in \"title.\" | did you mean title=...?");
  EXPECT_EQ(
      error_of(kSmallJob, {{"camera", "[1, 2"}}),
      "--set camera:1 [[] a list or section stands where a key belongs | close every [ and {, "
      "and put text that holds them in quotes");
}

TEST(Override, TakesThePlaceOfTheAlternativesInTheFile) {
  const std::string text = kSmallJob + "air: {turbidity: 3}\n";
  const JobConfig job = job_of({{"air.visibility", "20 km"}, {"time.frames", "5"}}, text);
  EXPECT_GT(job.air.turbidity[0].value, 3);
  EXPECT_EQ(std::get<FrameCount>(job.time.sampling).count, 5);
}

TEST(Override, TwoOverridesThatExcludeEachOtherAreAnError) {
  const std::string error =
      error_of(kSmallJob, {{"air.visibility", "20 km"}, {"air.turbidity", "3"}});
  EXPECT_NE(error.find("exclude each other"), std::string::npos) << error;
}

TEST(Override, TheLastOfTwoForOneKeyWins) {
  EXPECT_EQ(job_of({{"title", "first"}, {"title", "second"}}).title, "second");
}

}  // namespace
}  // namespace skylapse::config
