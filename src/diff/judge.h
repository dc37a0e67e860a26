#pragma once
// Measures against limits: findings in sentences, and the verdict.
#include <vector>

#include "diff/diff_result.h"
#include "diff/limits.h"
#include "image/diff/flip.h"
#include "image/diff/measure.h"

namespace skylapse::diff {

/// The place in the picture, and in the sky as far as `view` tells.
Place place_of(const image::PixelPlace& pixel, const std::vector<std::string>& channels,
               const image::SkyView& view);

/// The value with its limits and what they say.
MeasuredValue judged(const image::Measure& measure, const Limits& limits);

/// Adds the findings about samples that are no numbers or have become negative.
void judge_odd_samples(const image::OddSamples& odd, PairResult& pair);

/// Adds the values of the comparison, and a finding for each that is beyond a limit.
void judge_measures(const std::vector<image::Measure>& measures, const Limits& limits,
                    PairResult& pair);

/// FLIP's values as measures.
std::vector<image::Measure> flip_measures(const image::FlipResult& flip);

/// Drops the findings that the limits pass over, sets the severity of the others (a finding that is
/// a warning in itself never becomes more than the limits say), sorts them, and sets the verdict.
void conclude(const Limits& limits, PairResult& pair);

/// The same for the findings of the whole; returns the worst severity.
Verdict settle(const Limits& limits, std::vector<Finding>& findings);

}  // namespace skylapse::diff
