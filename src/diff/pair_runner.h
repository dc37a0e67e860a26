#pragma once
// Many pairs at once, and what becomes of them together.
#include <chrono>
#include <functional>
#include <vector>

#include "diff/run_diff.h"
#include "diff/sequence.h"

namespace skylapse::diff {

/// One pair on its way.
struct Task {
  size_t index = 0;
  PairResult result;
  PairTrace trace;
};

/// Calls `work` for every pair on several threads, pairs of large pictures one at a time so that
/// memory stays bounded, and `keep`
/// for one at a time. Errors: interrupted.
Status for_each_pair(const std::vector<FilePair>& pairs, const DiffOptions& options,
                     const std::function<void(Task&)>& work,
                     const std::function<void(Task&)>& keep);

/// for_each_pair that fills the result's pairs in the order of `pairs`, then judges sequences, adds
/// the findings of the whole, and sets the verdict.
Status run_pairs(const std::vector<FilePair>& pairs, const DiffOptions& options,
                 const std::function<void(Task&)>& work, std::vector<Finding> whole,
                 DiffResult& result);

/// Patterns of the names that rules leave out.
std::vector<std::string> ignored_names(const Rules& rules);

/// A comparison of nothing must not pass.
Error nothing_to_compare(const std::string& what);

}  // namespace skylapse::diff
