#pragma once
// A study of made-up measurements: a smooth sky as truth, rungs that are off by known shares.
#include "study/study_result.h"

namespace skylapse::study {

/// A rung whose sky is `1 + error` times the truth, in `ms` a frame.
Measurement sample_rung(const StudyScene& scene, const std::string& id, double error, double ms);

/// Two scenes with five rungs each, one of which was skipped.
StudyResult sample_study();

}  // namespace skylapse::study
