#pragma once
// Measures over time: frames that flicker, stand out of order, or stand still.
#include <string>
#include <vector>

#include "diff/compare_pair.h"
#include "diff/diff_result.h"
#include "diff/limits.h"

namespace skylapse::diff {

/// A frame of a sequence with its name.
struct TracedFrame {
  std::string name;
  PairTrace trace;
};

/// Findings about the frames of one sequence in their order in time:
/// sequence.repeated  a frame of B shows what the frame before it shows, where A moves on;
/// sequence.order     a frame of B shows what another frame of A shows;
/// sequence.flicker   light of a region against A: a frame differs from the mean of its neighbours.
/// Frames that could not be compared are passed over. Severities of the first two are those of
/// limits' checks (settle), of the third of its limits.
std::vector<Finding> judge_sequence(const std::vector<TracedFrame>& frames, const Limits& limits);

/// How different two small pictures are: root mean square over cells of the difference as a share
/// of the cell's mean (linear) or of the whole range (display). Infinite if one is empty.
double thumbnail_distance(const std::vector<float>& a, const std::vector<float>& b, bool display);

}  // namespace skylapse::diff
