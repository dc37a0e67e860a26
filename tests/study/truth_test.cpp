#include "study/truth.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "study/study_scenes.h"

namespace skylapse::study {
namespace {

struct Prepared {
  StudyScene scene;
  plan::Plan plan;
};

Prepared prepared(const std::string& name) {
  StudyOptions options;
  options.scenes = {name};
  Prepared p{scenes_of(options)->front(), {}};
  p.plan = *prepare_scene(p.scene, Sampling::quick);
  return p;
}

const std::vector<Direction<Enu>> kThree{enu_direction(0 * deg, 30 * deg),
                                         enu_direction(90 * deg, 60 * deg),
                                         enu_direction(200 * deg, 5 * deg)};

TEST(Truth, ErrorsShrinkAsAskedAndValuesAgree) {
  const Prepared p = prepared("noon");
  TruthSettings coarse, fine;
  coarse.wavelengths = fine.wavelengths = 4;
  coarse.noise = 0.04, fine.noise = 0.015;
  fine.seed = 2;
  const auto a = truth_of(p.plan, p.plan.frames[0], kThree, coarse);
  const auto b = truth_of(p.plan, p.plan.frames[0], kThree, fine);
  ASSERT_TRUE(a && b);
  for (size_t i = 0; i < kThree.size(); ++i) {
    const TrueRadiance &x = a->radiance[i], &y = b->radiance[i];
    // The error is that of eight batches: known to a quarter, so twice the wish is allowed.
    EXPECT_LT(glm::length(y.standard_error), 2 * fine.noise * glm::length(y.xyz));
    const double spread = glm::length(x.standard_error) + glm::length(y.standard_error);
    EXPECT_LT(glm::length(x.xyz - y.xyz), 5 * spread);
  }
  EXPECT_GT(b->paths, a->paths);
}

TEST(Truth, IsTheSameTwiceAndComesBackFromItsFile) {
  const Prepared p = prepared("low_sun");
  const auto folder = std::filesystem::path(::testing::TempDir()) / "truth_cache";
  std::filesystem::remove_all(folder);
  TruthSettings settings;
  settings.wavelengths = 3, settings.most_paths = 1000;
  const auto first = truth_of(p.plan, p.plan.frames[0], kThree, settings, folder);
  const auto again = truth_of(p.plan, p.plan.frames[0], kThree, settings);
  const auto kept = truth_of(p.plan, p.plan.frames[0], kThree, settings, folder);
  ASSERT_TRUE(first && again && kept);
  EXPECT_FALSE(first->from_cache);
  EXPECT_TRUE(kept->from_cache);
  for (size_t i = 0; i < kThree.size(); ++i) {
    EXPECT_EQ(first->radiance[i].xyz, again->radiance[i].xyz);
    EXPECT_EQ(first->radiance[i].xyz, kept->radiance[i].xyz);
    EXPECT_EQ(first->radiance[i].standard_error, kept->radiance[i].standard_error);
  }
  settings.seed = 9;
  EXPECT_FALSE(truth_of(p.plan, p.plan.frames[0], kThree, settings, folder)->from_cache);
}

TEST(Truth, ASignalEndsIt) {
  const Prepared p = prepared("noon");
  const std::atomic<int> signal = 2;
  const auto truth = truth_of(p.plan, p.plan.frames[0], kThree, {}, {}, &signal);
  ASSERT_FALSE(truth);
  EXPECT_EQ(truth.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace skylapse::study
