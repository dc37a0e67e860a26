#pragma once
// The command line of `skylapse diff` in the product's own types.
#include <string>
#include <vector>

#include "core/result.h"
#include "diff/run_diff.h"

namespace skylapse::cli {

/// As they are written.
struct DiffArguments {
  std::string a, b;
  std::string profile, rules, metric, fail_above, warn_above, fail_percent;
  std::vector<std::string> limits, checks, ignore;
  std::string heat_map, json, junit, html;
  std::string golden_folder, renderer, note;
  bool update = false, prune = false, self_check = false, no_flip = false, all = false;
  std::string projection, sun, psnr_peak, tone_mapper = "aces", exposures, pixels_per_degree;
  bool published_exposures = false;
  int jobs = 0;
};

/// All of them checked; errors name the option and what is allowed.
Result<diff::DiffOptions, Diagnostics> diff_options_of(const DiffArguments& arguments);

}  // namespace skylapse::cli
