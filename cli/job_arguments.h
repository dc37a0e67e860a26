#pragma once
// What render, plan and validate share: the config, its overrides, and which frames are meant.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "plan/plan.h"
#include "plan/work_list.h"

namespace skylapse::cli {

struct JobArguments {
  std::string config;
  std::vector<std::string> sets;
  std::string frames;
  std::string shard;
  std::string output = "out";
};

void add_job_options(CLI::App& command, JobArguments& arguments);

/// "key.path=value" as overrides; each without '=' is an error.
Result<std::vector<config::Override>, Diagnostics> parse_overrides(
    const std::vector<std::string>& sets);

/// A plan and this process's share of it.
struct PlannedWork {
  plan::Plan plan;
  std::vector<long> frames;  // numbers from 1
  plan::Shard shard;
};

/// Reads the config, plans it and picks frames by --frames and --shard (or the environment of an
/// array job).
Result<PlannedWork, Diagnostics> plan_work(const JobArguments& arguments);

}  // namespace skylapse::cli
