#pragma once
// Everything that belongs to one comparison: files, folders, manifests, goldens.
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "diff/compare_pair.h"
#include "diff/diff_result.h"
#include "diff/limits.h"

namespace skylapse::diff {

struct DiffOptions {
  std::string a, b;  // of goldens: `b` alone
  std::string golden_folder;
  std::string renderer;  // of B, for goldens; empty: what its manifest says
  bool prune = false;    // accepting drops goldens that B has no picture for
  Rules rules;
  PairOptions pair;
  int jobs = 0;  // pairs at once; 0: as many as threads
  std::function<void(const std::string& what, long done, long total)> on_progress;
};

/// Compares `a` with `b`. Unreadable files of a pair are told in the result. Errors: missing_input
/// and invalid_input of `a` and `b` as a whole, interrupted.
Result<DiffResult> run_diff(const DiffOptions& options);

/// Holds `b` against the accepted pictures of the folder: of a file with several of them, it has to
/// agree with the one of its renderer, or, where there is none, with any.
Result<DiffResult> run_golden_diff(const DiffOptions& options);

/// Whether limits still separate: the pairs of the result are goldens of different scenes that pass
/// for each other by their pixels, each with a finding "self-check".
Result<DiffResult> run_self_check(const DiffOptions& options);

/// Whether the folder holds goldens, readable or not.
bool has_goldens(const std::string& folder);

/// Copies `b` into the golden folder, for its renderer. Errors: as of update_goldens; pictures with
/// NaN or infinite samples are refused unless that check is passed over.
Status accept_goldens(const DiffOptions& options, const std::string& note);

}  // namespace skylapse::diff
