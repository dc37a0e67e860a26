#include <fmt/format.h>

#include <csignal>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/job_arguments.h"
#include "cli/plan_text.h"
#include "cli/progress.h"
#include "cli/signals.h"
#include "pipeline/run_job.h"

namespace skylapse::cli {
namespace {

struct RenderArguments {
  JobArguments job;
  std::string backend = "auto";
  int jobs = 0;
  bool overwrite = false;
  bool dry_run = false;
};

std::string summary_text(const pipeline::RunSummary& summary, const std::string& folder) {
  std::string text = fmt::format(
      "{} frames rendered, {} kept, {} written to {} in {}", summary.rendered, summary.kept,
      bytes_text(double(summary.bytes_written)), folder, duration_text(summary.seconds));
  if (summary.rendered > 0) {
    text += fmt::format(" ({:.2f} frames/s)\ntime per frame:",
                        double(summary.rendered) / summary.seconds);
    for (int i = 0; i < pipeline::kStageCount; ++i)
      text += fmt::format(" {} {:.1f} ms", pipeline::kStageNames[i],
                          summary.times.ms[i] / double(summary.rendered));
    text += fmt::format("; movies {:.1f} s, gallery and sheets {:.1f} s", summary.movie_seconds,
                        summary.library_seconds);
  }
  for (const std::string& note : summary.notes) text += "\nnote: " + note;
  return text;
}

nlohmann::ordered_json summary_json(const pipeline::RunSummary& summary) {
  nlohmann::ordered_json stages;
  for (int i = 0; i < pipeline::kStageCount; ++i)
    stages[std::string(pipeline::kStageNames[i])] = summary.times.ms[i];
  return {{"rendered", summary.rendered},
          {"kept", summary.kept},
          {"complete", summary.complete},
          {"bytes_written", summary.bytes_written},
          {"seconds", summary.seconds},
          {"movie_seconds", summary.movie_seconds},
          {"library_seconds", summary.library_seconds},
          {"stage_milliseconds", stages},
          {"notes", summary.notes}};
}

ExitCode run_render(const RenderArguments& arguments, const ConsoleOptions& console) {
  const auto backend = parse_backend(arguments.backend);
  if (!backend) return report(backend.error());
  if (arguments.jobs < 0)
    return report(option_error("--jobs", fmt::format("{} is out of range", arguments.jobs),
                               "allowed: 0 (all cores) and more"));
  const auto work = plan_work(arguments.job);
  if (!work) return report(work.error());
  if (arguments.dry_run) {
    print(console.json ? json_text(plan_json(*work)) : plan_text(*work));
    return ExitCode::done;
  }
  for (const std::string& text : work->plan.notes) note(console, "note: " + text);
  catch_signals();
  auto progress = std::make_unique<ProgressBar>(console);
  pipeline::RunOptions options;
  options.output = arguments.job.output;
  options.frames = work->frames;
  options.shard = work->shard;
  options.overwrite = arguments.overwrite;
  options.jobs = arguments.jobs;
  options.backend = *backend;
  options.stop_signal = &g_signal;
  options.on_progress = [&](const pipeline::Progress& p) { progress->show(p); };
  const auto summary = pipeline::run_job(work->plan, options);
  progress.reset();
  if (!summary) {
    const ExitCode code = report(summary.error());
    return code == ExitCode::interrupted && g_signal == SIGTERM ? ExitCode::terminated : code;
  }
  if (console.json)
    print(json_text(summary_json(*summary)));
  else
    note(console, summary_text(*summary, arguments.job.output));
  return ExitCode::done;
}

}  // namespace

void add_render_command(CLI::App& app, Session& session) {
  auto* command = add_command(
      app, session, "render", "Render everything a scene file asks for; finished frames are kept",
      "skylapse render configs/prague_solstice.yaml --output out/prague\n"
      "  skylapse render scene.yaml --set air.turbidity=4 --frames 1-240x10");
  auto arguments = std::make_shared<RenderArguments>();
  add_job_options(*command, arguments->job);
  add_backend_option(*command, arguments->backend);
  command->add_option("-j,--jobs", arguments->jobs, "Threads (default: all cores)");
  command->add_flag("--overwrite", arguments->overwrite, "Render finished frames again");
  command->add_flag("--dry-run", arguments->dry_run, "Print the plan and stop");
  command->callback([&session, arguments] {
    session.action = [&session, arguments] { return run_render(*arguments, session.console); };
  });
}

}  // namespace skylapse::cli
