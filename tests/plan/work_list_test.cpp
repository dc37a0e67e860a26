#include "plan/work_list.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

using namespace skylapse::plan;

namespace {

TEST(FrameList, ReadsNumbersRangesAndSteps) {
  EXPECT_EQ(*parse_frame_list("10-50x20,3", 100), (std::vector<long>{3, 10, 30, 50}));
  EXPECT_EQ(*parse_frame_list("98-", 100), (std::vector<long>{98, 99, 100}));
  EXPECT_EQ(*parse_frame_list("5,5,5-6", 100), (std::vector<long>{5, 6}));
}

TEST(FrameList, RefusesWhatTheJobDoesNotHave) {
  for (const char* bad : {"", "0", "101", "50-10", "a", "1-5x0", "1,,2", "-3", "1-2-3"})
    EXPECT_FALSE(parse_frame_list(bad, 100).ok()) << bad;
}

TEST(Shard, PartsAreDisjointAndCoverAllFrames) {
  std::vector<long> frames(103);
  for (size_t i = 0; i < frames.size(); ++i) frames[i] = long(i) + 1;
  std::multiset<long> seen;
  for (int part = 1; part <= 8; ++part)
    for (const long n : frames_of_shard(frames, {part, 8})) seen.insert(n);
  EXPECT_EQ(seen.size(), 103u);
  EXPECT_EQ(std::set<long>(seen.begin(), seen.end()).size(), 103u);
}

TEST(Shard, RefusesNonsense) {
  for (const char* bad : {"0/8", "9/8", "a/8", "1", "1/", "/8", "1/0", "-1/8", "1/8x"})
    EXPECT_FALSE(parse_shard(bad).ok()) << bad;
  EXPECT_EQ(parse_shard("2/8")->part, 2);
}

TEST(Shard, ArrayJobsNameTheirPart) {
  unsetenv("SLURM_ARRAY_TASK_ID");
  unsetenv("JOB_COMPLETION_INDEX");
  EXPECT_FALSE(shard_from_environment()->has_value());
  setenv("JOB_COMPLETION_INDEX", "0", 1);
  setenv("JOB_COMPLETION_COUNT", "4", 1);
  EXPECT_EQ((*shard_from_environment())->part, 1);
  setenv("SLURM_ARRAY_TASK_ID", "12", 1);
  setenv("SLURM_ARRAY_TASK_MIN", "10", 1);
  setenv("SLURM_ARRAY_TASK_COUNT", "4", 1);
  EXPECT_EQ((*shard_from_environment())->part, 3);
  EXPECT_EQ((*shard_from_environment())->parts, 4);
  setenv("SLURM_ARRAY_TASK_ID", "99", 1);
  const auto outside = shard_from_environment();
  ASSERT_FALSE(outside.ok());
  for (const char* named : {"SLURM_ARRAY_TASK_ID=99", "SLURM_ARRAY_TASK_COUNT=4"})
    EXPECT_NE(outside.error().message.find(named), std::string::npos) << outside.error().message;
  for (const char* name : {"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_COUNT",
                           "JOB_COMPLETION_INDEX", "JOB_COMPLETION_COUNT"})
    unsetenv(name);
}

TEST(Shard, ArraysWithAStepCountTheirParts) {  // --array=0-6:2 has the tasks 0, 2, 4, 6
  setenv("SLURM_ARRAY_TASK_MIN", "0", 1);
  setenv("SLURM_ARRAY_TASK_STEP", "2", 1);
  setenv("SLURM_ARRAY_TASK_COUNT", "4", 1);
  for (int part = 1; part <= 4; ++part) {
    setenv("SLURM_ARRAY_TASK_ID", std::to_string(2 * (part - 1)).c_str(), 1);
    const auto shard = shard_from_environment();
    ASSERT_TRUE(shard.ok()) << shard.error().message;
    EXPECT_EQ((*shard)->part, part);
    EXPECT_EQ((*shard)->parts, 4);
  }
  for (const auto& [id, step] : {std::pair("3", "2"), std::pair("8", "2"), std::pair("2", "0"),
                                 std::pair("2", "x"), std::pair("-2", "2")}) {
    setenv("SLURM_ARRAY_TASK_ID", id, 1);
    setenv("SLURM_ARRAY_TASK_STEP", step, 1);
    EXPECT_FALSE(shard_from_environment().ok()) << id << " by " << step;
  }
  for (const char* name : {"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_STEP",
                           "SLURM_ARRAY_TASK_COUNT"})
    unsetenv(name);
}

}  // namespace
