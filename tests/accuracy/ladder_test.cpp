// The stored bounds and the choice among outlooks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "plan/accuracy_choice.h"
#include "study/fit_errors.h"

namespace skylapse::plan {
namespace {

using config::SkyModel;
using sky::bruneton::Level;

constexpr int kScenes = 400;

PictureScene scene_of(int index) {
  PictureScene scene;
  scene.features = study::features_of(study::draw_scene(5, index));
  scene.shares.fill(1.0 / kSkyParts);
  return scene;
}

double bound(SkyModel model, Level level, int wavelengths, const PictureScene& scene) {
  return error_bound({model, level, wavelengths}, scene);
}

TEST(ErrorBounds, StoredTableIsPositiveAndItsMarginsAreAtLeastOne) {
  for (const ErrorRow& row : stored_errors()) {
    for (const double base : row.base) EXPECT_GT(base, 0);
    for (const double factor : row.factor) EXPECT_GT(factor, 0);
    EXPECT_GE(row.margin, 1);
  }
}

TEST(ErrorBounds, MoreBandsNeverHaveAGreaterBound) {
  for (int i = 0; i < kScenes; ++i) {
    const PictureScene scene = scene_of(i);
    double before = 1e9;
    for (const int bands : {4, 8, 16, 32}) {
      const double error = bound(SkyModel::bruneton, Level::standard, bands, scene);
      EXPECT_LE(error, before) << "scene " << i << ", " << bands << " bands";
      before = error;
    }
  }
}

TEST(ErrorBounds, DraftIsNeverPromisedToBeBetterThanFine) {
  for (int i = 0; i < kScenes; ++i) {
    const PictureScene scene = scene_of(i);
    EXPECT_LE(bound(SkyModel::bruneton, Level::fine, 16, scene),
              bound(SkyModel::bruneton, Level::standard, 16, scene))
        << "scene " << i;
    EXPECT_LE(bound(SkyModel::bruneton, Level::fine, 16, scene),
              bound(SkyModel::bruneton, Level::draft, 16, scene))
        << "scene " << i;
  }
}

TEST(ErrorBounds, BoundsAreContinuousInTheSunsElevation) {
  // A twentieth of a degree of the sun moves no bound by more than a tenth. Thick haze counts as
  // unknown air below some elevation, which is a step.
  for (int i = 0; i < 50; ++i) {
    const PictureScene a = scene_of(i);
    if (a.features.aerosol_depth > 0.4) continue;
    for (int step = 0; step < 200; ++step) {
      PictureScene low = a, high = a;
      low.features.sun_elevation = (-11.9 + 0.5 * step) * deg;
      high.features.sun_elevation = low.features.sun_elevation + 0.05 * deg;
      for (const Rung& rung : ladder())
        EXPECT_NEAR(error_bound(rung, high) / error_bound(rung, low), 1, 0.1) << name_of(rung);
    }
  }
}

TEST(ErrorBounds, PictureWithoutSkyHasNoError) {
  PictureScene scene = scene_of(1);
  scene.shares.fill(0);
  for (const Rung& rung : ladder()) EXPECT_EQ(error_bound(rung, scene), 0);
}

TEST(ErrorBounds, ThickHazeUnderALowSunCountsAsUnknown) {
  SceneFeatures scene = scene_of(1).features;
  scene.aerosol_depth = 1, scene.ground_albedo = 0.2;
  scene.sun_elevation = 30 * deg;
  EXPECT_TRUE(within_calibration(scene));
  scene.sun_elevation = -5 * deg;
  EXPECT_FALSE(within_calibration(scene));
  scene.aerosol_depth = 0.1;
  EXPECT_TRUE(within_calibration(scene));
}

TEST(ErrorBounds, ThickHazeInTwilightPromisesNothing) {
  PictureScene scene = scene_of(1);
  scene.features.aerosol_depth = 1, scene.features.sun_elevation = -8 * deg;
  for (const Rung& rung : ladder()) EXPECT_GE(error_bound(rung, scene), 1) << name_of(rung);
}

TEST(ErrorBounds, UnknownAirIsTakenForTwiceAsBad) {
  PictureScene scene = scene_of(1);
  const Rung rung{SkyModel::bruneton, Level::low, 16};
  const double known = error_bound(rung, scene);
  scene.known_air = false;
  EXPECT_DOUBLE_EQ(error_bound(rung, scene), kUnknownAir * known);
}

std::vector<Outlook> four() {
  return {{"a", 0.3, 0.1}, {"b", 0.05, 0.2}, {"c", 0.06, 0.4}, {"d", 0.01, 2}};
}

TEST(Choice, TakesTheCheapestThatKeepsTheAccuracy) {
  EXPECT_EQ(cheapest_within(four(), 0.5), 0u);
  EXPECT_EQ(cheapest_within(four(), 0.3), 0u);
  EXPECT_EQ(cheapest_within(four(), 0.07), 1u);
  EXPECT_EQ(cheapest_within(four(), 0.02), 3u);
  EXPECT_EQ(cheapest_within(four(), 0.001), std::nullopt);
}

TEST(Choice, TighterPromisesNeverCostLessNorErrMore) {
  double error = 1, cost = 0;
  for (double accuracy = 0.4; accuracy >= 0.01; accuracy *= 0.9) {
    const Outlook taken = four()[*cheapest_within(four(), accuracy)];
    EXPECT_LE(taken.error, error);
    EXPECT_GE(taken.core_seconds, cost);
    EXPECT_LE(taken.error, accuracy);
    error = taken.error, cost = taken.core_seconds;
  }
}

TEST(Choice, BudgetTakesTheMostAccurateThatFits) {
  EXPECT_EQ(best_within(four(), 0.05 * second), std::nullopt);
  EXPECT_EQ(best_within(four(), 0.1 * second), 0u);
  EXPECT_EQ(best_within(four(), 1.0 * second), 1u);  // not c, which costs more for less
  EXPECT_EQ(best_within(four(), 3.0 * second), 3u);
}

}  // namespace
}  // namespace skylapse::plan
