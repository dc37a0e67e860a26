#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "cli/job_arguments.h"

namespace skylapse::cli {

/// The plan for a reader: the job, one line a frame, effects with reasons, time and bytes.
std::string plan_text(const PlannedWork& work);
nlohmann::ordered_json plan_json(const PlannedWork& work);

/// "3.4 GB", "12 min 5 s".
std::string bytes_text(double bytes);
std::string duration_text(double seconds);

}  // namespace skylapse::cli
