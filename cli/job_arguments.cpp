#include "cli/job_arguments.h"

#include <fmt/format.h>

#include <numeric>

#include "cli/commands.h"

namespace skylapse::cli {

void add_job_options(CLI::App& command, JobArguments& arguments) {
  command.add_option("config", arguments.config, "Scene file (YAML)")->required();
  command.add_option("--set", arguments.sets, "Override a value: key.path=value (repeatable)")
      ->allow_extra_args(false);
  command.add_option("--frames", arguments.frames, "Only these frames: 7, 10-50, 10-50x5, 10-");
  command.add_option("--shard", arguments.shard,
                     "Only part K of N: K/N (default: from SLURM or indexed-job variables)");
  add_output_option(command, arguments.output, "Output folder (default: out)");
}

Result<std::vector<config::Override>, Diagnostics> parse_overrides(
    const std::vector<std::string>& sets) {
  std::vector<config::Override> overrides;
  Diagnostics errors;
  for (const std::string& set : sets) {
    const size_t equals = set.find('=');
    if (equals == std::string::npos || equals == 0)
      errors.push_back({ErrorCode::invalid_input,
                        fmt::format("--set: '{}' sets nothing", set),
                        {},
                        "write key.path=value, for example air.turbidity=3"});
    else
      overrides.push_back({set.substr(0, equals), set.substr(equals + 1)});
  }
  if (!errors.empty()) return errors;
  return overrides;
}

Result<PlannedWork, Diagnostics> plan_work(const JobArguments& arguments) {
  const auto overrides = parse_overrides(arguments.sets);
  if (!overrides) return overrides.error();
  auto job = config::load_job(arguments.config, *overrides);
  if (!job) return job.error();
  auto plan = plan::make_plan(*std::move(job));
  if (!plan) return plan.error();
  PlannedWork work{*std::move(plan), {}, {}};
  work.frames.resize(work.plan.frames.size());
  std::iota(work.frames.begin(), work.frames.end(), 1L);
  if (!arguments.frames.empty()) {
    auto frames = plan::parse_frame_list(arguments.frames, long(work.plan.frames.size()));
    if (!frames) return Diagnostics{frames.error()};
    work.frames = *std::move(frames);
  }
  if (!arguments.shard.empty()) {
    const auto shard = plan::parse_shard(arguments.shard);
    if (!shard) return Diagnostics{shard.error()};
    work.shard = *shard;
  } else {
    const auto shard = plan::shard_from_environment();
    if (!shard) return Diagnostics{shard.error()};
    if (*shard) work.shard = **shard;
  }
  work.frames = plan::frames_of_shard(work.frames, work.shard);
  return work;
}

}  // namespace skylapse::cli
