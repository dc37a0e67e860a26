#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "study/sample_study.h"

namespace skylapse::study {
namespace {

TEST(StudyResult, FrontHoldsWhatNothingElseBeats) {
  const StudyResult study = sample_study();
  EXPECT_THAT(pareto_front(study.scenes[0].rungs), ::testing::ElementsAre(0, 2, 1));
}

TEST(StudyResult, CheapestRungWithinAnErrorIsOnTheFront) {
  const auto rungs = sample_study().scenes[0].rungs;
  EXPECT_EQ(cheapest_within(rungs, 0.10), 2);
  EXPECT_EQ(cheapest_within(rungs, 0.02), 1);
  EXPECT_EQ(cheapest_within(rungs, 0.001), -1);
}

TEST(StudyResult, RungsOfTheSampleHaveTheErrorTheyWereMadeWith) {
  const auto rungs = sample_study().scenes[1].rungs;
  // Pixels are floats; 0.1 % of noise in the truth is taken off.
  EXPECT_NEAR(rungs[0].errors.sky().raw_rms, 0.30, 1e-6);
  EXPECT_NEAR(rungs[1].errors.sky().raw_rms, 0.01, 1e-6);
}

TEST(StudyResult, MiddleAndQuartilesAreThoseOfTheTimes) {
  const Spread spread = spread_of({4, 1, 3, 2, 5});
  EXPECT_EQ(spread.median, 3);
  EXPECT_EQ(spread.lower, 2);
  EXPECT_EQ(spread.upper, 4);
  EXPECT_EQ(spread.count, 5);
  EXPECT_EQ(spread_of({}).count, 0);
}

/// Fields of one line, quotes resolved.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
      fields.back() += line[++i];
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += line[i];
  }
  return fields;
}

TEST(StudyCsv, EveryRowHasTheColumnsOfTheHeading) {
  std::istringstream csv(study_csv(sample_study()));
  std::string line;
  std::getline(csv, line);
  const auto heading = fields_of(line);
  EXPECT_THAT(heading, ::testing::IsSupersetOf({"scene", "rung", "rms", "frame_ms", "truth_noise",
                                                "table_bytes", "skipped"}));
  int rows = 0;
  for (; std::getline(csv, line); ++rows) EXPECT_EQ(fields_of(line).size(), heading.size()) << line;
  EXPECT_EQ(rows, 10);
}

TEST(StudyCsv, SkippedRungsKeepTheirReason) {
  EXPECT_THAT(study_csv(sample_study()),
              ::testing::HasSubstr("\"needs \"\"another\"\" sky, really\""));
}

}  // namespace
}  // namespace skylapse::study
