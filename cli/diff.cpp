#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/progress.h"
#include "cli/signals.h"
#include "config/quantity_parser.h"
#include "diff/evidence.h"
#include "diff/reports.h"
#include "diff/run_diff.h"
#include "diff/wording.h"
#include "image/camera/camera_words.h"

namespace skylapse::cli {
namespace {

struct DiffArguments {
  std::string a, b;
  std::string profile, rules, metric, fail_above, warn_above, fail_percent;
  std::vector<std::string> limits, checks, ignore;
  std::string heat_map, json, junit, html;
  std::string golden_folder, renderer, note;
  bool update = false, self_check = false, no_flip = false, all = false;
  std::string projection, sun, psnr_peak, tone_mapper = "aces", exposures, pixels_per_degree;
  bool published_exposures = false;
  int jobs = 0;
};

Result<double> parse_value(const std::string& option, const std::string& text) {
  const auto value = diff::parse_limit(text);
  if (value) return *value;
  return option_error(option, fmt::format("'{}' is no limit", text),
                      "a number from 0 up, with or without %");
}

/// "relative.rms=0.5 %", "relative.max=1 %,0.2 %" (fail, warn).
Status read_limit(const std::string& text, diff::Rules& rules) {
  const size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  if (diff::kind_of(name) == nullptr) {
    std::vector<std::string> names;
    for (const auto& kind : diff::measure_kinds()) names.emplace_back(kind.name);
    const auto near = nearest_name(name, names);
    return option_error("--limit", fmt::format("unknown measure '{}'", name),
                        near ? fmt::format("did you mean {}?", *near)
                             : fmt::format("known: {}", fmt::join(names, ", ")));
  }
  if (equals == std::string::npos)
    return option_error("--limit", fmt::format("'{}' has no value", text),
                        "write NAME=FAIL or NAME=FAIL,WARN: relative.rms=0.5%");
  const std::string values = text.substr(equals + 1);
  const size_t comma = values.find(',');
  const auto fail = parse_value("--limit", values.substr(0, comma));
  if (!fail) return fail.error();
  diff::Limit limit{.warn = diff::kNone, .fail = *fail};
  if (comma != std::string::npos) {
    const auto warn = parse_value("--limit", values.substr(comma + 1));
    if (!warn) return warn.error();
    limit.warn = *warn;
  }
  rules.measures[name] = limit;
  return Done{};
}

/// "stored-type=fail".
Status read_check(const std::string& text, diff::Rules& rules) {
  const size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const std::string word = equals == std::string::npos ? "" : text.substr(equals + 1);
  const auto& names = diff::check_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    const auto near = nearest_name(name, names);
    return option_error("--check", fmt::format("unknown check '{}'", name),
                        near ? fmt::format("did you mean {}?", *near)
                             : fmt::format("known: {}", fmt::join(names, ", ")));
  }
  if (word != "fail" && word != "warn" && word != "ignore")
    return option_error("--check", fmt::format("'{}' is no severity", word),
                        "allowed: fail, warn, ignore");
  rules.checks[name] = word == "fail"   ? diff::Severity::fail
                       : word == "warn" ? diff::Severity::warn
                                        : diff::Severity::ignore;
  return Done{};
}

Result<diff::Rules, Diagnostics> rules_of(const DiffArguments& a) {
  diff::Rules rules;
  if (!a.rules.empty()) {
    auto read = diff::read_rules(a.rules);
    if (!read) return read.error();
    rules = *std::move(read);
  }
  if (!a.profile.empty()) {
    rules.profile = diff::profile_from_name(a.profile);
    const auto near = nearest_name(a.profile, diff::profile_names());
    if (!rules.profile)
      return Diagnostics{option_error(
          "--profile", fmt::format("'{}' is no profile", a.profile),
          fmt::format("{}allowed: {}", near ? fmt::format("did you mean {}? ", *near) : "",
                      fmt::join(diff::profile_names(), ", ")))};
  }
  for (const std::string& limit : a.limits)
    if (const Status read = read_limit(limit, rules); !read) return Diagnostics{read.error()};
  for (const std::string& check : a.checks)
    if (const Status read = read_check(check, rules); !read) return Diagnostics{read.error()};
  rules.ignore.insert(rules.ignore.end(), a.ignore.begin(), a.ignore.end());
  return rules;
}

/// --fail-above and its companions; nothing if none of them is used.
Result<std::optional<diff::SimpleLimit>> simple_limit_of(const DiffArguments& a) {
  if (a.fail_above.empty() && a.warn_above.empty()) {
    if (a.metric.empty() && a.fail_percent.empty()) return std::optional<diff::SimpleLimit>();
    return option_error(a.metric.empty() ? "--fail-percent" : "--metric",
                        "says nothing without a limit", "add --fail-above E or --warn-above E");
  }
  diff::SimpleLimit simple;
  if (!a.metric.empty()) simple.metric = a.metric;
  const std::vector<std::string> metrics{"relative", "absolute", "flip"};
  if (std::find(metrics.begin(), metrics.end(), simple.metric) == metrics.end())
    return option_error("--metric", fmt::format("'{}' is no measure of pixels", simple.metric),
                        fmt::format("allowed: {}", fmt::join(metrics, ", ")));
  for (const auto& [option, text, target] :
       {std::tuple("--fail-above", &a.fail_above, &simple.fail),
        std::tuple("--warn-above", &a.warn_above, &simple.warn)}) {
    if (text->empty()) continue;
    const auto value = parse_value(option, *text);
    if (!value) return value.error();
    *target = *value;
  }
  if (!a.fail_percent.empty()) {
    const auto percent = config::parse_number(a.fail_percent);
    if (!percent || *percent < 0 || *percent > 100)
      return option_error("--fail-percent", fmt::format("'{}' is no share", a.fail_percent),
                          "allowed: 0 to 100");
    simple.percent = *percent;
  }
  return std::optional(simple);
}

Status read_view(const DiffArguments& a, diff::PairOptions& options) {
  if (!a.projection.empty()) {
    const auto projection = image::projection_from_name(a.projection);
    if (!projection || !image::sees_whole_sphere(*projection))
      return option_error("--projection", fmt::format("'{}' is no map of the sphere", a.projection),
                          "allowed: lat-long, cube, octahedral, mirror-ball");
    options.camera = image::Camera{};
    options.camera->projection = *projection;
  }
  if (a.sun.empty()) return Done{};
  const size_t comma = a.sun.find(',');
  const auto degrees = [](const std::string& text) -> std::optional<double> {
    const auto number = config::parse_number(config::plain_text(text));
    return number ? std::optional(*number) : std::nullopt;
  };
  const auto az = degrees(a.sun.substr(0, comma));
  const auto el = comma == std::string::npos ? std::nullopt : degrees(a.sun.substr(comma + 1));
  if (!az || !el || std::fabs(*az) > 360 || std::fabs(*el) > 90)
    return option_error("--sun", fmt::format("'{}' is no direction", a.sun),
                        "write AZIMUTH,ELEVATION in degrees: 182.5,40.1");
  options.sun = enu_direction(*az * deg, *el * deg);
  return Done{};
}

Status read_flip(const DiffArguments& a, image::FlipOptions& flip) {
  flip.published_exposures = a.published_exposures;
  if (a.tone_mapper == "hable")
    flip.tone_mapper = image::ToneMapper::hable;
  else if (a.tone_mapper == "reinhard")
    flip.tone_mapper = image::ToneMapper::reinhard;
  else if (a.tone_mapper != "aces")
    return option_error("--flip-tone-mapper", fmt::format("'{}' is unknown", a.tone_mapper),
                        "allowed: aces, hable, reinhard");
  if (!a.pixels_per_degree.empty()) {
    const auto ppd = config::parse_number(a.pixels_per_degree);
    if (!ppd || *ppd < 1 || *ppd > 1000)
      return option_error("--flip-ppd", fmt::format("'{}' is out of range", a.pixels_per_degree),
                          "allowed: 1 to 1000 pixels per degree");
    flip.pixels_per_degree = *ppd;
  }
  if (a.exposures.empty()) return Done{};
  // START,STOP,COUNT
  std::vector<double> numbers;
  for (size_t at = 0; at <= a.exposures.size();) {
    const size_t comma = std::min(a.exposures.find(',', at), a.exposures.size());
    const auto number =
        config::parse_number(config::plain_text(a.exposures.substr(at, comma - at)));
    if (number) numbers.push_back(*number);
    at = comma + 1;
  }
  if (numbers.size() != 3 || numbers[0] > numbers[1] || numbers[2] < 1 || numbers[2] > 64 ||
      std::fabs(numbers[0]) > 100 || std::fabs(numbers[1]) > 100)
    return option_error("--flip-exposures", fmt::format("'{}' is no range", a.exposures),
                        "write START,STOP,COUNT in stops: -6,2,5");
  flip.start = numbers[0], flip.stop = numbers[1], flip.exposures = int(numbers[2]);
  return Done{};
}

Result<diff::DiffOptions, Diagnostics> options_of(const DiffArguments& a) {
  auto rules = rules_of(a);
  if (!rules) return rules.error();
  diff::DiffOptions options;
  options.rules = *std::move(rules);
  auto simple = simple_limit_of(a);
  if (!simple) return Diagnostics{simple.error()};
  options.pair.simple = *simple;
  options.pair.flip = !a.no_flip;
  if (const Status view = read_view(a, options.pair); !view) return Diagnostics{view.error()};
  if (const Status flip = read_flip(a, options.pair.flip_options); !flip)
    return Diagnostics{flip.error()};
  if (!a.psnr_peak.empty()) {
    const auto peak = config::parse_number(a.psnr_peak);
    if (!peak || !(*peak > 0))
      return Diagnostics{option_error("--psnr-peak", fmt::format("'{}' is no peak", a.psnr_peak),
                                      "a number above 0")};
    options.pair.psnr_peak = *peak;
  }
  if (a.jobs < 0 || a.jobs > 1024)
    return Diagnostics{option_error("--jobs", fmt::format("{} is out of range", a.jobs),
                                    "allowed: 1 to 1024; 0 for as many as there are cores")};
  options.jobs = a.jobs;
  options.golden_folder = a.golden_folder, options.renderer = a.renderer;
  const bool golden = !a.golden_folder.empty();
  if (golden && !a.b.empty())
    return Diagnostics{option_error("--golden-dir", "takes the place of A",
                                    "write skylapse diff B --golden-dir DIR")};
  if (!golden && (a.update || a.self_check))
    return Diagnostics{option_error(a.update ? "--update-golden" : "--self-check", "needs goldens",
                                    "add --golden-dir DIR")};
  if (a.a.empty() && !a.self_check)
    return Diagnostics{option_error("diff", golden ? "B is missing" : "A and B are missing",
                                    "write skylapse diff A B, or B --golden-dir DIR")};
  if (!golden && a.b.empty())
    return Diagnostics{option_error("diff", "B is missing", "write skylapse diff A B")};
  options.a = golden ? std::string() : a.a, options.b = golden ? a.a : a.b;
  options.stop_signal = &g_signal;
  return options;
}

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
  if (!a.junit.empty()) note_error(diff::write_report(a.junit, diff::junit_report(result)));
  if (!a.html.empty()) note_error(diff::write_page(result, a.html));
  if (a.heat_map.empty()) return all;
  for (const size_t i : diff::worst_first(result.pairs)) {
    if (result.pairs[i].error) continue;  // there is nothing to draw
    note_error(diff::write_heat_map(result.pairs[i], a.heat_map));
    break;
  }
  return all;
}

ExitCode exit_code(const diff::DiffResult& result) {
  if (result.unreadable) return ExitCode::missing_input;
  switch (result.verdict) {
    case diff::Verdict::same:
      return ExitCode::done;
    case diff::Verdict::warning:
      return ExitCode::differs_within_warning;
    case diff::Verdict::different:
      break;
  }
  return ExitCode::differs;
}

/// The first acceptance has nothing to compare with.
bool is_first_acceptance(const DiffArguments& a) {
  std::error_code none;
  return a.update && (!std::filesystem::exists(a.golden_folder, none) ||
                      std::filesystem::is_empty(a.golden_folder, none));
}

ExitCode accept(const DiffArguments& a, const diff::DiffOptions& options,
                const ConsoleOptions& console) {
  if (const Status accepted = diff::accept_goldens(options, a.note); !accepted)
    return report(accepted.error());
  note(console, fmt::format("goldens in {} are now those of {}", a.golden_folder, options.b));
  return ExitCode::done;
}

ExitCode run_diff_command(const DiffArguments& a, const ConsoleOptions& console) {
  auto options = options_of(a);
  if (!options) return report(options.error());
  if (is_first_acceptance(a)) return accept(a, *options, console);
  catch_signals();
  auto progress = std::make_unique<ProgressBar>(console);
  const auto begun = std::chrono::steady_clock::now();
  options->on_progress = [&](const std::string&, long done, long total) {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun;
    if (total > 16) progress->show({done, total, 0, taken.count(), "comparing"});
  };
  const auto result = a.self_check              ? diff::run_self_check(*options)
                      : a.golden_folder.empty() ? diff::run_diff(*options)
                                                : diff::run_golden_diff(*options);
  progress.reset();
  if (!result) {
    const ExitCode code = report(result.error());
    return code == ExitCode::interrupted && g_signal == SIGTERM ? ExitCode::terminated : code;
  }
  if (!console.quiet && a.json != "-") print(result_text(*result, a.all));
  for (const auto& pair : result->pairs)
    if (pair.error) report(*pair.error);
  if (const Status written = write_reports(a, *result); !written) return report(written.error());
  if (!a.update) return exit_code(*result);
  return accept(a, *options, console);
}

void add_report_options(CLI::App& command, DiffArguments& a) {
  command.add_option("--heatmap", a.heat_map,
                     "Errors of the worst pair in false colour (.png), or as numbers (.exr)");
  command.add_option("--json", a.json, "Report as JSON; - for standard output");
  command.add_option("--junit", a.junit, "Report as JUnit XML");
  command.add_option("--html", a.html, "Folder of a page with pictures, index.html");
  command.add_flag("--all", a.all, "A line for every pair, not only for those that differ");
}

void add_golden_options(CLI::App& command, DiffArguments& a) {
  command.add_option("--golden-dir", a.golden_folder, "Accepted pictures, in the place of A");
  command.add_option("--renderer", a.renderer,
                     "What rendered B (default: as its manifest says): which golden comes first");
  command.add_flag("--update-golden", a.update,
                   "Show the differences, then accept B as the golden of its renderer");
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
