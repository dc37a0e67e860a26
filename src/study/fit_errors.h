#pragma once
// From measured scenes to the table that the planner reads.
#include <string>
#include <vector>

#include "plan/error_bounds.h"
#include "study/calibration_file.h"

namespace skylapse::study {

/// What the errors of a scene depend on.
plan::SceneFeatures features_of(const AccuracyScene& scene);

/// Fits, for each part of the error, the mean square as a product of a base for each part of the
/// sky and a factor for each feature: quasi-likelihood with a log link, so that values with noise,
/// negative ones too, weigh by their uncertainty; smooth over neighbouring nodes. Margins are such
/// that 19 of 20 pictures of scenes that the fit has not seen (five folds, ten cameras a scene)
/// stay within; for the noisy part `fine` the margin is that of a normal deviate.
plan::ErrorTable fit_errors(const std::vector<MeasuredScene>& scenes);

/// Text of data/accuracy/error_bounds.table.
std::string table_text(const plan::ErrorTable& table, const std::string& source);

}  // namespace skylapse::study
