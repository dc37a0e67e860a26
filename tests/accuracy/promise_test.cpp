// sky.accuracy and sky.time_budget in whole jobs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "plan/accuracy_choice.h"
#include "plan/plan.h"

namespace skylapse::plan {
namespace {

using config::SkyModel;
using testing::HasSubstr;

/// A job of one camera; `sky` is the section's text.
std::string job_text(const std::string& sky, const std::string& times,
                     const std::string& more = "") {
  return fmt::format(
      "location: {{latitude: 50 deg, longitude: 14 deg, height: 200 m}}\n"
      "time: {{at: [{}]}}\nsky: {{{}}}\n"
      "camera: {{projection: lat-long, size: 256x128}}\noutputs: [{{image: \"####.exr\"}}]\n{}",
      times, sky, more);
}
constexpr const char* kNoon = "\"2026-06-21T11:00Z\"";
constexpr const char* kDayAndDusk = "\"2026-06-21T11:00Z\", \"2026-06-21T20:00Z\"";

Result<Plan, Diagnostics> plan_of(const std::string& text) {
  auto job = config::parse_job(text, "job.yaml");
  if (!job) return job.error();
  return make_plan(*std::move(job));
}

TEST(Promise, AccuracyChoosesLevelAndBandsAndSaysWhatTheNextBetterCosts) {
  const auto plan = plan_of(job_text("accuracy: 5 %", kNoon));
  ASSERT_TRUE(plan);
  ASSERT_TRUE(plan->promise);
  EXPECT_LE(plan->promise->taken.error, 0.05);
  ASSERT_TRUE(plan->promise->next_better);
  EXPECT_LT(plan->promise->next_better->error, plan->promise->taken.error);
  const std::string text = promise_text(*plan->promise);
  EXPECT_THAT(text, HasSubstr("taken"));
  EXPECT_THAT(text, HasSubstr("next better"));
  EXPECT_THAT(plan->model_reason, HasSubstr("sky.accuracy"));
  EXPECT_TRUE(plan->job.sky.wavelengths_given);
}

TEST(Promise, IsTheCheapestOfTheLadderThatKeepsIt) {
  for (const char* accuracy : {"2 %", "4 %", "8 %", "20 %", "60 %"}) {
    const auto plan = plan_of(job_text(std::string("accuracy: ") + accuracy, kNoon));
    ASSERT_TRUE(plan) << accuracy;
    for (const Outlook& other : plan->promise->ladder)
      if (other.core_seconds < plan->promise->taken.core_seconds) {
        EXPECT_GT(other.error, *plan->promise->accuracy) << other.name;
      }
  }
}

TEST(Promise, TighterAccuracyNeverTakesAGreaterError) {
  double before = 1;
  for (const char* accuracy : {"80 %", "40 %", "20 %", "10 %", "5 %", "3 %", "2 %"}) {
    const auto plan = plan_of(job_text(std::string("accuracy: ") + accuracy, kNoon));
    ASSERT_TRUE(plan) << accuracy;
    EXPECT_LE(plan->promise->taken.error, before);
    before = plan->promise->taken.error;
  }
}

TEST(Promise, WithoutAPromiseNothingChanges) {
  const auto plan = plan_of(job_text("level: low", kNoon));
  ASSERT_TRUE(plan);
  EXPECT_FALSE(plan->promise);
  EXPECT_EQ(plan->job.sky.level, sky::bruneton::Level::low);
}

TEST(Promise, SunBelowTheHorizonInOneFrameExcludesFittedModels) {
  const auto day = plan_of(job_text("accuracy: 100 %", kNoon));
  const auto dusk = plan_of(job_text("accuracy: 100 %", kDayAndDusk));
  ASSERT_TRUE(day);
  ASSERT_TRUE(dusk);
  const auto has_fit = [](const Plan& plan) {
    return std::ranges::any_of(plan.promise->ladder,
                               [](const Outlook& o) { return o.name == "hosek-wilkie"; });
  };
  EXPECT_TRUE(has_fit(*day));
  EXPECT_FALSE(has_fit(*dusk));
  EXPECT_FALSE(is_fitted(dusk->model));
}

TEST(Promise, HoldsForTheWorstPictureOfTheJob) {
  const auto noon = plan_of(job_text("accuracy: 20 %", kNoon));
  const auto both = plan_of(job_text("accuracy: 20 %", kDayAndDusk));
  ASSERT_TRUE(noon);
  ASSERT_TRUE(both);
  EXPECT_LE(both->promise->taken.error, 0.2);
  for (const Outlook& of_both : both->promise->ladder)
    for (const Outlook& of_noon : noon->promise->ladder)
      if (of_both.name == of_noon.name) {
        EXPECT_GE(of_both.error, of_noon.error) << of_both.name;
      }
}

TEST(Promise, UnreachableAccuracyIsAnErrorThatSaysWhatCanBePromised) {
  const auto plan = plan_of(job_text("accuracy: 0.1 %", kNoon));
  ASSERT_FALSE(plan);
  const Error& error = plan.error().front();
  EXPECT_EQ(error.code, ErrorCode::invalid_input);
  EXPECT_GT(error.span.line, 0);
  EXPECT_THAT(error.message, HasSubstr("is good to"));
  EXPECT_THAT(error.hint, HasSubstr("model: reference"));
  EXPECT_THAT(error.hint, HasSubstr("of one core a frame"));
}

TEST(Promise, SmallPicturesGoToTheReferenceWhereTablesDoNotSuffice) {
  std::string text = job_text("accuracy: 0.2 %", kNoon);
  text.replace(text.find("256x128"), 7, "4x2");
  const auto plan = plan_of(text);
  ASSERT_TRUE(plan) << plan.error().front().message;
  EXPECT_EQ(plan->model, SkyModel::reference);
  EXPECT_EQ(plan->job.sky.paths.relative_error, 0.002);
  EXPECT_LE(plan->promise->taken.core_seconds, kLongestReference.in(second));
}

TEST(Promise, BudgetIsKeptAndNothingBetterFitsIt) {
  for (const char* budget : {"50 ms", "200 ms", "1 s", "5 s", "1 min"}) {
    const auto plan = plan_of(job_text(std::string("time_budget: ") + budget, kNoon));
    ASSERT_TRUE(plan) << budget;
    const Promise& promise = *plan->promise;
    if (!promise.kept) continue;
    EXPECT_LE(promise.taken.core_seconds, promise.time_budget->in(second)) << budget;
    for (const Outlook& other : promise.ladder)
      if (other.core_seconds <= promise.time_budget->in(second)) {
        EXPECT_GE(other.error, promise.taken.error) << budget << ", " << other.name;
      }
  }
}

TEST(Promise, BudgetThatNothingFitsTakesTheCheapestAndSaysSo) {
  const auto plan = plan_of(job_text("time_budget: 1 ms", kDayAndDusk));
  ASSERT_TRUE(plan);
  EXPECT_FALSE(plan->promise->kept);
  EXPECT_EQ(plan->promise->taken.name, plan->promise->ladder.front().name);
  EXPECT_THAT(promise_text(*plan->promise), HasSubstr("nothing keeps"));
}

TEST(Promise, TablesAreSharedByTheFramesOfAJob) {
  const auto one = plan_of(job_text("accuracy: 5 %", kNoon));
  const auto three = plan_of(job_text(
      "accuracy: 5 %", "\"2026-06-21T11:00Z\", \"2026-06-21T11:10Z\", \"2026-06-21T11:20Z\""));
  ASSERT_TRUE(one);
  ASSERT_TRUE(three);
  const auto cost_of_finest = [](const Plan& plan) {
    return plan.promise->ladder.back().core_seconds;
  };
  EXPECT_LT(cost_of_finest(*three), 0.5 * cost_of_finest(*one));
}

TEST(Promise, MeansBesideThePromiseAreRefused) {
  for (const char* means :
       {"level: fine", "wavelengths: 8", "orders: 3", "fit: rgb", "effects: [sun-disc]"}) {
    const auto plan = plan_of(job_text(std::string("accuracy: 5 %, ") + means, kNoon));
    ASSERT_FALSE(plan) << means;
    EXPECT_THAT(plan.error().front().message, HasSubstr("beside")) << means;
  }
}

TEST(Promise, PictureOfTheGroundAloneIsPromisedTheWholeSky) {
  std::string text = job_text("accuracy: 2 %", kNoon);
  const std::string map = "projection: lat-long, size: 256x128";
  text.replace(text.find(map), map.size(), "look_at: nadir, fov: 40 deg, size: 160x90");
  const auto plan = plan_of(text);
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->model, config::SkyModel::bruneton);
  EXPECT_GT(plan->promise->taken.error, 0);
}

TEST(SkyModelChoice, KeysOfAnAtmosphereAreWhatTheConfigAsksFor) {
  for (const char* key : {"orders: 2", "steps: 8", "slice: 32x64", "precision: double"}) {
    const auto plan = plan_of(job_text(key, kNoon));
    ASSERT_TRUE(plan) << key;
    EXPECT_EQ(plan->model, config::SkyModel::bruneton) << key;
  }
  for (const char* key : {"samples: 8", "seed: 2", "cie_type: 5"})
    EXPECT_FALSE(plan_of(job_text(key, kNoon))) << key;
}

}  // namespace
}  // namespace skylapse::plan
