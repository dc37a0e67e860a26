#include "diff/run_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>

#include "core/parallel.h"
#include "core/pipeline.h"
#include "diff/goldens.h"
#include "diff/judge.h"
#include "diff/sequence.h"
#include "diff/wording.h"

namespace skylapse::diff {
namespace {

/// Pairs whose files together are larger than this are compared one after another: a picture may
/// take sixteen times the bytes of its file in memory.
constexpr uint64_t kLargeFiles = uint64_t{64} << 20;

uint64_t bytes_of(const std::string& path) {
  std::error_code ignored;
  const auto size = std::filesystem::file_size(path, ignored);
  return ignored ? 0 : size;
}

bool is_large(const FilePair& pair) { return bytes_of(pair.a) + bytes_of(pair.b) > kLargeFiles; }

bool stopped(const DiffOptions& options) {
  return options.stop_signal != nullptr && *options.stop_signal != 0;
}

/// One pair on its way.
struct Task {
  size_t index = 0;
  PairResult result;
  PairTrace trace;
};

/// Calls `work` for every task on several threads, pairs of large files one at a time.
Status for_each_pair(const std::vector<FilePair>& pairs, const DiffOptions& options,
                     const std::function<void(Task&)>& work,
                     const std::function<void(Task&)>& keep) {
  std::vector<size_t> small, large;
  for (size_t i = 0; i < pairs.size(); ++i) (is_large(pairs[i]) ? large : small).push_back(i);
  long done = 0;
  const auto finish = [&](Task& task) {
    keep(task);
    if (options.on_progress)
      options.on_progress(pairs[task.index].name, ++done, long(pairs.size()));
  };
  const auto run = [&](const std::vector<size_t>& order, size_t in_flight) {
    size_t at = 0;
    const auto next = [&]() -> std::optional<Task> {
      if (at >= order.size() || stopped(options)) return {};
      Task task;
      task.index = order[at++];
      return task;
    };
    run_pipeline<Task>(in_flight, next, work, finish, FinishOrder::as_done);
  };
  run(small, size_t(options.jobs > 0 ? options.jobs : allowed_threads()));
  run(large, 1);
  if (stopped(options))
    return Error{.code = ErrorCode::interrupted, .message = "the comparison was stopped"};
  return Done{};
}

/// Findings about the sequences among the pairs; limits are those of a sequence's first frame.
void judge_sequences(const std::vector<FilePair>& pairs, std::vector<PairTrace>& traces,
                     const Rules& rules, DiffResult& result) {
  std::map<int, std::vector<TracedFrame>> sequences;
  for (size_t i = 0; i < pairs.size(); ++i)
    if (pairs[i].sequence >= 0)
      sequences[pairs[i].sequence].push_back({pairs[i].name, std::move(traces[i])});
  for (const auto& [number, frames] : sequences) {
    const Limits limits = limits_for(rules, frames.front().name);
    std::vector<Finding> findings = judge_sequence(frames, limits);
    result.verdict = std::max(result.verdict, settle(limits, findings));
    result.findings.insert(result.findings.end(), findings.begin(), findings.end());
  }
}

/// The files that are not to be passed over.
void drop_ignored(const Rules& rules, PairList& list) {
  std::erase_if(list.pairs, [&](const FilePair& p) { return is_ignored(rules, p.name); });
}

void finish(DiffResult& result, const Rules& rules, std::vector<Finding> whole,
            std::chrono::steady_clock::time_point begun) {
  const Verdict verdict = settle(limits_for(rules, ""), whole);
  result.findings.insert(result.findings.begin(), whole.begin(), whole.end());
  result.verdict = std::max(result.verdict, verdict);
  for (const PairResult& pair : result.pairs) {
    result.unreadable = result.unreadable || pair.error.has_value();
    result.verdict = std::max(result.verdict, pair.error ? Verdict::different : pair.verdict);
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

/// The likeliest variant that passes, else the one that comes nearest to passing.
Task against_variants(const FilePair& tested, const Golden& golden, const DiffOptions& options) {
  const Limits limits = limits_for(options.rules, tested.name);
  Task best;
  double least = 0;
  for (const GoldenVariant& variant : variants_for(golden, renderer_of(tested, options.renderer))) {
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
    if (!best.result.error && best.result.verdict == Verdict::same) break;
  }
  return best;
}

}  // namespace

Result<DiffResult> run_diff(const DiffOptions& options) {
  const auto begun = std::chrono::steady_clock::now();
  auto list = pair_files(options.a, options.b, options.rules.ignore);
  if (!list) return list.error();
  drop_ignored(options.rules, *list);
  DiffResult result;
  result.a = options.a, result.b = options.b;
  result.pairs.resize(list->pairs.size());
  std::vector<PairTrace> traces(list->pairs.size());
  const Status compared = for_each_pair(
      list->pairs, options,
      [&](Task& task) {
        const FilePair& pair = list->pairs[task.index];
        task.result =
            compare_pair(pair, limits_for(options.rules, pair.name), options.pair, &task.trace);
      },
      [&](Task& task) {
        result.pairs[task.index] = std::move(task.result);
        traces[task.index] = std::move(task.trace);
      });
  if (!compared) return compared.error();
  judge_sequences(list->pairs, traces, options.rules, result);
  finish(result, options.rules, std::move(list->findings), begun);
  return result;
}

Result<DiffResult> run_golden_diff(const DiffOptions& options) {
  const auto begun = std::chrono::steady_clock::now();
  const auto goldens = read_goldens(options.golden_folder);
  if (!goldens) return goldens.error();
  auto list = list_files(options.b, options.rules.ignore);
  if (!list) return list.error();
  drop_ignored(options.rules, *list);
  std::map<std::string, const Golden*> by_name;
  for (const Golden& golden : *goldens) by_name[golden.name] = &golden;
  std::vector<Finding> whole = std::move(list->findings);
  std::vector<FilePair> tested;
  for (FilePair& file : list->pairs) {
    if (by_name.contains(file.name))
      tested.push_back(std::move(file));
    else
      whole.push_back({Verdict::different,
                       "sequence.extra",
                       fmt::format("{} has no golden", one_line(file.name)),
                       {}});
  }
  for (const Golden& golden : *goldens)
    if (!is_ignored(options.rules, golden.name) &&
        std::none_of(tested.begin(), tested.end(),
                     [&](const FilePair& file) { return file.name == golden.name; }))
      whole.push_back({Verdict::different,
                       "sequence.missing",
                       fmt::format("{} has a golden and was not rendered", one_line(golden.name)),
                       {}});
  DiffResult result;
  result.a = options.golden_folder, result.b = options.b;
  result.pairs.resize(tested.size());
  std::vector<PairTrace> traces(tested.size());
  const Status compared = for_each_pair(
      tested, options,
      [&](Task& task) {
        const FilePair& file = tested[task.index];
        const size_t index = task.index;
        task = against_variants(file, *by_name.at(file.name), options);
        task.index = index;
      },
      [&](Task& task) {
        result.pairs[task.index] = std::move(task.result);
        traces[task.index] = std::move(task.trace);
      });
  if (!compared) return compared.error();
  judge_sequences(tested, traces, options.rules, result);
  finish(result, options.rules, std::move(whole), begun);
  return result;
}

Status accept_goldens(const DiffOptions& options, const std::string& note) {
  auto list = list_files(options.b, options.rules.ignore);
  if (!list) return list.error();
  drop_ignored(options.rules, *list);
  return update_goldens({options.golden_folder, options.renderer, note}, list->pairs);
}

}  // namespace skylapse::diff
