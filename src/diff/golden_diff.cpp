// Files against accepted pictures, and accepted pictures against each other.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "diff/goldens.h"
#include "diff/pair_runner.h"
#include "diff/wording.h"

namespace skylapse::diff {
namespace {

using GoldensByName = std::map<std::string, const Golden*>;

/// The variant of the same renderer; where there is none the likeliest that passes, else the one
/// that comes nearest to passing.
Task against_variants(const FilePair& tested, const Golden& golden, const DiffOptions& options) {
  const Limits limits = limits_for(options.rules, tested.name);
  Task best;
  double least = 0;
  const std::string renderer = renderer_of(tested, options.renderer);
  for (const GoldenVariant& variant : variants_for(golden, renderer)) {
    FilePair pair = tested;
    pair.a = (std::filesystem::path(options.golden_folder) / variant.file).string();
    Task task;
    task.result = compare_pair(pair, limits, options.pair, &task.trace);
    task.result.golden = variant.renderer.empty() ? "an unknown renderer" : variant.renderer;
    const MeasuredValue* worst = worst_measure(task.result.measures);
    const double ratio = worst != nullptr ? limit_ratio(*worst) : 0;
    const auto rank = [](const PairResult& r) { return r.error ? 3 : int(r.verdict); };
    const bool first = best.result.name.empty();
    if (first || rank(task.result) < rank(best.result) ||
        (rank(task.result) == rank(best.result) && ratio < least)) {
      best = std::move(task);
      least = ratio;
    }
    // What its own renderer made decides; of others any may agree.
    if (variant.renderer == renderer) break;
    if (!best.result.error && best.result.verdict == Verdict::same) break;
  }
  return best;
}

/// The tested files that have a golden; those without, and goldens without a file, are findings.
std::vector<FilePair> matched(PairList& list, const GoldensByName& goldens, const Rules& rules,
                              std::vector<Finding>& whole) {
  std::vector<FilePair> tested;
  std::set<std::string> names;
  for (FilePair& file : list.pairs) {
    names.insert(file.name);
    if (goldens.contains(file.name))
      tested.push_back(std::move(file));
    else
      whole.push_back({Verdict::different,
                       "sequence.extra",
                       fmt::format("{} has no golden", one_line(file.name)),
                       {}});
  }
  for (const auto& [name, golden] : goldens)
    if (!names.contains(name) && !is_ignored(rules, name))
      whole.push_back({Verdict::different,
                       "sequence.missing",
                       fmt::format("{} has a golden and was not rendered", one_line(name)),
                       {}});
  return tested;
}

/// Goldens that somebody has changed without accepting them.
Status check_goldens(const std::string& folder, const std::vector<Golden>& goldens,
                     std::vector<Finding>& whole) {
  for (const Golden& golden : goldens)
    for (const GoldenVariant& variant : golden.variants) {
      const auto same = is_as_accepted(folder, variant);
      if (!same) return same.error();
      if (!*same)
        whole.push_back({Verdict::different,
                         "golden-changed",
                         fmt::format("golden {} is not the file that was accepted (--update-golden "
                                     "accepts a new one)",
                                     one_line(variant.file)),
                         {}});
    }
  return Done{};
}

}  // namespace

Result<DiffResult> run_golden_diff(const DiffOptions& options) {
  const auto goldens = read_goldens(options.golden_folder);
  if (!goldens) return goldens.error();
  auto list = list_files(options.b, ignored_names(options.rules));
  if (!list) return list.error();
  GoldensByName by_name;
  for (const Golden& golden : *goldens) by_name[golden.name] = &golden;
  std::vector<Finding> whole = std::move(list->findings);
  const std::vector<FilePair> tested = matched(*list, by_name, options.rules, whole);
  if (const Status sound = check_goldens(options.golden_folder, *goldens, whole); !sound)
    return sound.error();
  DiffResult result;
  result.a = options.golden_folder, result.b = options.b;
  const auto work = [&](Task& task) {
    const FilePair& file = tested[task.index];
    const size_t index = task.index;
    task = against_variants(file, *by_name.at(file.name), options);
    task.index = index;
  };
  const Status compared = run_pairs(tested, options, work, std::move(whole), result);
  if (!compared) return compared.error();
  return result;
}

Result<DiffResult> run_self_check(const DiffOptions& options) {
  const auto goldens = read_goldens(options.golden_folder);
  if (!goldens) return goldens.error();
  const auto contrasts = golden_contrasts(options.golden_folder, *goldens);
  if (!contrasts) return contrasts.error();
  if (contrasts->empty())
    return nothing_to_compare(options.golden_folder + " has no two goldens of different scenes");
  std::vector<FilePair> pairs;
  const std::filesystem::path folder(options.golden_folder);
  for (const GoldenContrast& contrast : *contrasts) {
    FilePair pair;
    pair.name = contrast.name_a + " against " + contrast.name_b;
    pair.a = (folder / contrast.file_a).string(), pair.b = (folder / contrast.file_b).string();
    pairs.push_back(std::move(pair));
  }
  // Pixels alone have to tell them apart: that files name other times is no proof of the limits.
  DiffOptions blind = options;
  for (const std::string& check : check_names())
    if (check.starts_with("metadata.")) blind.rules.checks[check] = Severity::ignore;
  DiffResult result;
  result.a = result.b = options.golden_folder;
  // Under the limits of either name: rules of one path must not blind the other's.
  const auto work = [&](Task& task) {
    const GoldenContrast& contrast = (*contrasts)[task.index];
    for (const std::string& name : {contrast.name_a, contrast.name_b}) {
      task.result = compare_pair(pairs[task.index], limits_for(blind.rules, name), blind.pair);
      if (task.result.error || task.result.verdict != Verdict::different) return;
    }
  };
  const Status compared = run_pairs(pairs, blind, work, {}, result);
  if (!compared) return compared.error();
  // What differs is as it should be; what is left is what passes for another.
  result.contrasts = result.pairs.size();
  std::erase_if(result.pairs,
                [](const PairResult& p) { return !p.error && p.verdict == Verdict::different; });
  for (PairResult& pair : result.pairs) {
    if (pair.error) continue;
    pair.verdict = Verdict::different;
    pair.findings.insert(pair.findings.begin(),
                         {Verdict::different,
                          "self-check",
                          "the limits do not tell these goldens of different scenes apart",
                          {}});
  }
  result.verdict = result.pairs.empty() ? Verdict::same : Verdict::different;
  return result;
}

namespace {

/// Pictures with NaN or infinite samples are no reference: later checks could not tell what is
/// wrong from what was accepted.
Status check_fit(const std::vector<FilePair>& files, const DiffOptions& options) {
  PairOptions quick = options.pair;
  quick.flip = false;
  for (FilePair file : files) {
    file.a = file.b, file.manifest_entry_a = file.manifest_entry_b;
    const Limits limits = limits_for(options.rules, file.name);
    const PairResult pair = compare_pair(file, limits, quick);
    if (pair.error) return *pair.error;
    for (const Finding& finding : pair.findings)
      if (finding.check == "odd-reference")
        return Error{
            .code = ErrorCode::invalid_input,
            .message = fmt::format("{} is no golden: {}", one_line(file.name), finding.message),
            .hint = "--check odd-reference=ignore accepts it"};
  }
  return Done{};
}

}  // namespace

Status accept_goldens(const DiffOptions& options, const std::string& note) {
  const auto list = list_files(options.b, ignored_names(options.rules));
  if (!list) return list.error();
  if (const Status fit = check_fit(list->pairs, options); !fit) return fit;
  return update_goldens({options.golden_folder, options.renderer, note, options.prune},
                        list->pairs);
}

bool has_goldens(const std::string& folder) {
  const auto goldens = read_goldens(folder);
  std::error_code none;
  return goldens.ok() ||
         std::filesystem::exists(std::filesystem::path(folder) / "golden.json", none);
}

}  // namespace skylapse::diff
