#pragma once
// The pictures of a pair and their maps of errors, read again for the reports.
#include <vector>

#include "diff/diff_result.h"
#include "image/diff/picture.h"

namespace skylapse::diff {

struct PairEvidence {
  image::Picture a, b;
  std::vector<float> error;  // image::Comparison::error; empty if the pictures cannot be compared
  std::vector<float> flip;   // FLIP map, planned exposures; empty as `error`
};

/// Reads both files again. Errors: missing_input.
Result<PairEvidence> read_evidence(const PairResult& pair);

}  // namespace skylapse::diff
