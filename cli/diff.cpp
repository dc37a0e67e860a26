#include <fmt/format.h>

#include <csignal>

#include "cli/commands.h"
#include "cli/diff_arguments.h"
#include "cli/progress.h"
#include "cli/signals.h"
#include "diff/reports.h"
#include "diff/wording.h"

namespace skylapse::cli {
namespace {

std::string colored(diff::Verdict verdict, const std::string& text) {
  if (!use_color(stdout) || verdict == diff::Verdict::same) return text;
  const char* color = verdict == diff::Verdict::warning ? "\033[33m" : "\033[1;31m";
  return color + text + "\033[0m";
}

/// A line for each pair that is not the same (with --all for all, and for the only one), what is
/// wrong with the whole, and the sums.
std::string result_text(const diff::DiffResult& result, bool all) {
  std::string text;
  for (const auto& pair : result.pairs)
    if (all || result.pairs.size() == 1 || pair.error || pair.verdict != diff::Verdict::same)
      text +=
          colored(pair.error ? diff::Verdict::different : pair.verdict, diff::summary_line(pair)) +
          "\n";
  for (const auto& finding : result.findings)
    text += colored(finding.severity, fmt::format("{:<10} {}: {}", diff::name_of(finding.severity),
                                                  finding.check, finding.message)) +
            "\n";
  if (result.contrasts > 0)
    return text + fmt::format("{} pairs of goldens, {} not told apart ({:.1f} s)\n",
                              result.contrasts, result.pairs.size(), result.seconds);
  if (result.pairs.size() == 1 && result.findings.empty()) return text;
  const diff::Counts counts = diff::counts_of(result);
  return text +
         fmt::format("{} pairs: {} same, {} with warnings, {} different{} ({:.1f} s)\n",
                     result.pairs.size(), counts.same, counts.warning, counts.different,
                     counts.unreadable > 0 ? fmt::format(", {} unreadable", counts.unreadable) : "",
                     result.seconds);
}

/// Writes all reports that were asked for, whatever happens to one of them; the first error.
Status write_reports(const DiffArguments& a, const diff::DiffResult& result) {
  Status all = Done{};
  const auto note_error = [&](Status written) {
    if (all.ok() && !written.ok()) all = std::move(written);
  };
  if (a.json == "-")
    print(diff::json_report(result));
  else if (!a.json.empty())
    note_error(diff::write_report(a.json, diff::json_report(result)));
  if (a.junit == "-")
    print(diff::junit_report(result));
  else if (!a.junit.empty())
    note_error(diff::write_report(a.junit, diff::junit_report(result)));
  if (!a.html.empty()) note_error(diff::write_page(result, a.html));
  if (a.heat_map.empty()) return all;
  for (const size_t i : diff::worst_first(result.pairs)) {
    if (result.pairs[i].error) continue;  // there is nothing to draw
    note_error(diff::write_heat_map(result.pairs[i], a.heat_map));
    break;
  }
  return all;
}

ExitCode accept(const DiffArguments& a, const diff::DiffOptions& options,
                const ConsoleOptions& console) {
  if (const Status accepted = diff::accept_goldens(options, a.note); !accepted)
    return report(accepted.error());
  note(console, fmt::format("goldens in {} are now those of {}", a.golden_folder, options.b));
  return ExitCode::done;
}

ExitCode run_diff_command(const DiffArguments& a, const ConsoleOptions& console) {
  auto options = diff_options_of(a);
  if (!options) return report(options.error());
  options->pair.stop_signal = &g_signal;
  catch_signals();
  auto progress = std::make_unique<ProgressBar>(console);
  const auto begun = std::chrono::steady_clock::now();
  options->on_progress = [&](const std::string&, long done, long total) {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun;
    if (total > 16) progress->show({done, total, 0, taken.count(), "comparing"});
  };
  // The first acceptance has nothing to compare with.
  const bool first = a.update && !diff::has_goldens(a.golden_folder);
  const auto result = first                     ? Result<diff::DiffResult>(diff::DiffResult{})
                      : a.self_check            ? diff::run_self_check(*options)
                      : a.golden_folder.empty() ? diff::run_diff(*options)
                                                : diff::run_golden_diff(*options);
  progress.reset();
  if (!result) {
    const ExitCode code = report(result.error());
    return code == ExitCode::interrupted && g_signal == SIGTERM ? ExitCode::terminated : code;
  }
  if (!console.quiet && a.json != "-" && a.junit != "-" && !first)
    print(result_text(*result, a.all));
  for (const auto& pair : result->pairs)
    if (pair.error) report(*pair.error);
  const auto verdict = ExitCode(diff::exit_code_of(*result));
  if (const Status written = write_reports(a, *result); !written) {
    // That pictures differ is the more important of the two.
    const ExitCode code = report(written.error());
    return verdict == ExitCode::done ? code : verdict;
  }
  if (!a.update) return verdict;
  return accept(a, *options, console);
}

void add_report_options(CLI::App& command, DiffArguments& a) {
  command.add_option("--heatmap", a.heat_map,
                     "Errors of the worst pair in false colour (.png), or as numbers (.exr)");
  command.add_option("--json", a.json, "Report as JSON; - for standard output");
  command.add_option("--junit", a.junit, "Report as JUnit XML; - for standard output");
  command.add_option("--html", a.html, "Folder of a page with pictures, index.html");
  command.add_flag("--all", a.all, "A line for every pair, not only for those that differ");
}

void add_golden_options(CLI::App& command, DiffArguments& a) {
  command.add_option("--golden-dir", a.golden_folder, "Accepted pictures, in the place of A");
  command.add_option("--renderer", a.renderer,
                     "What rendered B (default: as its manifest says): which golden comes first");
  command.add_flag("--update-golden", a.update,
                   "Show the differences, then accept B as the golden of its renderer");
  command.add_flag("--prune", a.prune, "With it: drop goldens that B has no picture for");
  command.add_option("--note", a.note, "Why, kept beside the goldens");
  command.add_flag("--self-check", a.self_check,
                   "Whether goldens of different scenes differ under the limits");
}

void add_measure_options(CLI::App& command, DiffArguments& a) {
  command.add_option(
      "--projection", a.projection,
      "Of maps that do not say: lat-long, cube, octahedral, mirror-ball (north ahead)");
  command.add_option("--sun", a.sun, "AZIMUTH,ELEVATION of the sun where files do not say");
  command.add_option("--psnr-peak", a.psnr_peak, "Peak value of psnr");
  command.add_flag("--no-flip", a.no_flip, "Leave the perceptual measure out");
  command.add_option("--flip-exposures", a.exposures,
                     "START,STOP,COUNT in stops (default: planned)");
  command.add_flag("--flip-published", a.published_exposures,
                   "Plan exposures from A's maximum and median, as HDR-FLIP's authors do");
  command.add_option("--flip-tone-mapper", a.tone_mapper, "aces, hable or reinhard");
  command.add_option("--flip-ppd", a.pixels_per_degree, "Pixels per degree of the viewer (67.02)");
  command.add_option("--jobs", a.jobs, "Pairs at once (default: one a core)");
}

}  // namespace

void add_diff_command(CLI::App& app, Session& session) {
  // --json names a file here, as all reports do.
  auto* command = app.add_subcommand(
      "diff", "Compares pictures of skies: files, folders or manifests, with limits for CI");
  command->footer(
      "Example:\n  skylapse diff golden.exr out/frame.exr\n"
      "  skylapse diff golden/ out/ --html report --junit report.xml\n"
      "  skylapse diff out/ --golden-dir goldens --profile same-renderer\n"
      "Exit codes: 0 the same, 1 within the warning limits, 2 different, 3 wrong arguments, 4 "
      "unreadable");
  command->add_flag("-q,--quiet", session.console.quiet, "Print no lines, progress or notes");
  auto a = std::make_shared<DiffArguments>();
  command->add_option("A", a->a, "Reference: a file, a folder, or a manifest.json");
  command->add_option("B", a->b, "What is tested");
  command->add_option(
      "--profile", a->profile,
      fmt::format("{} (default: cross-renderer)", fmt::join(diff::profile_names(), ", ")));
  command->add_option("--rules", a->rules, "Limits by path (YAML)");
  command->add_option("--limit", a->limits, "NAME=FAIL or NAME=FAIL,WARN; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--check", a->checks, "NAME=fail, warn or ignore; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--ignore", a->ignore, "Names left out, \"thumbs/**\"; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--fail-above", a->fail_above,
                      "Instead of a profile: pixels with a larger error fail");
  command->add_option("--fail-percent", a->fail_percent, "... if there are more than that percent");
  command->add_option("--warn-above", a->warn_above, "Pixels with a larger error warn");
  command->add_option("--metric", a->metric,
                      "What these limits are of: relative (display: code values), absolute, flip");
  add_report_options(*command, *a);
  add_golden_options(*command, *a);
  add_measure_options(*command, *a);
  command->callback([&session, a] {
    session.action = [&session, a] { return run_diff_command(*a, session.console); };
  });
}

}  // namespace skylapse::cli
