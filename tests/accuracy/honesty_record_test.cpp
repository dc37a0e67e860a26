// The recorded test of honesty: its promises are those that the planner makes today, and they were
// kept.
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "plan/plan.h"
#include "study/honesty.h"

namespace skylapse::study {
namespace {

struct Record {
  uint64_t seed = 0;
  int index = 0;
  double promise = 0;
  std::string taken;
  double bound = 0, measured = 0, predicted_s = 0, best_predicted_s = 0;
  std::string refused;
};

/// Rows of the CSV that accuracy_honesty writes; quotes stand around fields with commas.
std::vector<Record> records() {
  std::ifstream in(SKYLAPSE_TEST_DATA "/accuracy/honesty.csv");
  std::vector<Record> all;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (const char c : line) {
      if (c == '"')
        quoted = !quoted;
      else if (c == ',' && !quoted)
        fields.emplace_back();
      else
        fields.back() += c;
    }
    if (fields.size() != 16) continue;
    Record r;
    r.seed = std::stoull(fields[0]), r.index = std::stoi(fields[1]);
    r.promise = std::stod(fields[6]), r.taken = fields[7], r.bound = std::stod(fields[8]);
    r.measured = std::stod(fields[9]), r.predicted_s = std::stod(fields[11]);
    r.best_predicted_s = std::stod(fields[13]), r.refused = fields[15];
    all.push_back(r);
  }
  return all;
}

TEST(Honesty, AtLeast95PercentOfPromisesWereKeptOverAtLeast50Scenes) {
  int promised = 0, kept = 0;
  for (const Record& r : records()) {
    if (!r.refused.empty()) continue;
    ++promised;
    kept += r.measured <= r.promise;
  }
  EXPECT_GE(promised, 50);
  EXPECT_GE(kept, 0.95 * promised);
}

TEST(Honesty, MeanCostIsWellBelowAlwaysTakingTheBestRung) {
  double taken = 0, best = 0;
  for (const Record& r : records()) taken += r.predicted_s, best += r.best_predicted_s;
  ASSERT_GT(best, 0);
  EXPECT_LT(taken, 0.5 * best);
}

TEST(Honesty, RecordIsOfThePlannerAsItIs) {
  // A change of bounds or ladder wants a new record: accuracy_honesty run,
  // docs/accuracy-promises.md.
  for (const Record& r : records()) {
    const HonestyJob drawn = draw_honesty_job(r.seed, r.index);
    EXPECT_NEAR(drawn.accuracy, r.promise, 1e-4);
    auto job = config::parse_job(drawn.config, "honesty.yaml");
    ASSERT_TRUE(job) << drawn.config;
    const auto plan = plan::make_plan(*std::move(job));
    EXPECT_EQ(bool(plan), r.refused.empty()) << "scene " << r.index;
    if (!plan) continue;
    EXPECT_EQ(plan->promise->taken.name, r.taken) << "scene " << r.index;
    EXPECT_NEAR(plan->promise->taken.error, r.bound, 2e-4) << "scene " << r.index;
    EXPECT_LE(plan->promise->taken.error, drawn.accuracy);
  }
}

}  // namespace
}  // namespace skylapse::study
