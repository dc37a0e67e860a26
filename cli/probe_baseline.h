#pragma once
// probe for the baselines: Preetham and the CIE general sky.
#include <string>

#include "cli/console.h"
#include "cli/exit_code.h"

namespace skylapse::cli {

bool is_baseline_model(const std::string& model);

/// `batch`: CSV as of hosek-wilkie; `kind` is xyz (the dome) or solar_direct (the disc alone),
/// `band` X, Y or Z. Appends radiance and luminance. For cie the optional column `cie_type`.
ExitCode run_baseline_probe(const std::string& model, const std::string& batch,
                            const ConsoleOptions& console);

}  // namespace skylapse::cli
