#include "diff/pair_runner.h"

#include <algorithm>
#include <map>

#include "core/parallel.h"
#include "core/pipeline.h"
#include "diff/judge.h"

namespace skylapse::diff {
namespace {

/// What the pairs that are compared at once may take together; one that takes more is alone.
constexpr double kMemory = 2.0 * (1 << 30);

/// Two pictures of floats, two maps of errors, and what measuring takes beside them.
double memory_of(const FilePair& pair) {
  const auto io = output::open_image_io();
  if (!io) return 0;
  const auto header = (*io)->read_header(pair.b, 0, ReadLimits{});
  if (!header) return 0;  // told when it is read
  const double pixels = double(header->width) * header->height;
  return pixels * double(2 * sizeof(float) * header->channels.size() + 3 * sizeof(float));
}

bool stopped(const DiffOptions& options) {
  return options.pair.stop_signal != nullptr && *options.pair.stop_signal != 0;
}

/// Findings about the sequences among the pairs; limits are those of a sequence's first frame.
void judge_sequences(const std::vector<FilePair>& pairs, std::vector<PairTrace>& traces,
                     const DiffOptions& options, DiffResult& result) {
  std::map<int, std::vector<TracedFrame>> sequences;
  for (size_t i = 0; i < pairs.size(); ++i)
    if (pairs[i].sequence >= 0)
      sequences[pairs[i].sequence].push_back({pairs[i].name, std::move(traces[i])});
  for (const auto& [number, frames] : sequences) {
    Limits limits = limits_for(options.rules, frames.front().name);
    if (options.pair.simple) limits.measures.clear();  // pixels alone decide
    std::vector<Finding> findings = judge_sequence(frames, limits);
    result.verdict = std::max(result.verdict, settle(limits, findings));
    result.findings.insert(result.findings.end(), findings.begin(), findings.end());
  }
}

/// The worst of the findings and of the pairs.
void conclude_all(const Rules& rules, std::vector<Finding> whole, DiffResult& result) {
  result.verdict = std::max(result.verdict, settle(limits_for(rules, ""), whole));
  result.findings.insert(result.findings.begin(), whole.begin(), whole.end());
  for (const PairResult& pair : result.pairs) {
    result.unreadable = result.unreadable || pair.error.has_value();
    result.verdict = std::max(result.verdict, pair.error ? Verdict::different : pair.verdict);
  }
}

}  // namespace

Status for_each_pair(const std::vector<FilePair>& pairs, const DiffOptions& options,
                     const std::function<void(Task&)>& work,
                     const std::function<void(Task&)>& keep) {
  const int jobs = options.jobs > 0 ? options.jobs : allowed_threads();
  std::vector<size_t> small, large;
  for (size_t i = 0; i < pairs.size(); ++i)
    (memory_of(pairs[i]) * jobs > kMemory ? large : small).push_back(i);
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
  run(small, size_t(jobs));
  run(large, 1);
  if (stopped(options))
    return Error{.code = ErrorCode::interrupted, .message = "the comparison was stopped"};
  return Done{};
}

Status run_pairs(const std::vector<FilePair>& pairs, const DiffOptions& options,
                 const std::function<void(Task&)>& work, std::vector<Finding> whole,
                 DiffResult& result) {
  const auto begun = std::chrono::steady_clock::now();
  result.pairs.resize(pairs.size());
  std::vector<PairTrace> traces(pairs.size());
  const Status compared = for_each_pair(pairs, options, work, [&](Task& task) {
    result.pairs[task.index] = std::move(task.result);
    traces[task.index] = std::move(task.trace);
  });
  if (!compared) return compared;
  judge_sequences(pairs, traces, options, result);
  conclude_all(options.rules, std::move(whole), result);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return Done{};
}

std::vector<std::string> ignored_names(const Rules& rules) {
  std::vector<std::string> globs = rules.ignore;
  for (const PathRule& rule : rules.paths)
    if (rule.ignore) globs.push_back(rule.path);
  return globs;
}

Error nothing_to_compare(const std::string& what) {
  return {.code = ErrorCode::missing_input,
          .message = what + ": there is nothing to compare",
          .hint = "look at what is left out (--ignore, ignore in the rules)"};
}

}  // namespace skylapse::diff
