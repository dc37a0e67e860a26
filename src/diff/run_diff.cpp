#include "diff/run_diff.h"

#include "diff/pair_runner.h"

namespace skylapse::diff {

Result<DiffResult> run_diff(const DiffOptions& options) {
  auto list = pair_files(options.a, options.b, ignored_names(options.rules));
  if (!list) return list.error();
  if (list->pairs.empty() && list->findings.empty()) return nothing_to_compare(options.b);
  DiffResult result;
  result.a = options.a, result.b = options.b;
  const auto work = [&](Task& task) {
    const FilePair& pair = list->pairs[task.index];
    task.result =
        compare_pair(pair, limits_for(options.rules, pair.name), options.pair, &task.trace);
  };
  const Status compared = run_pairs(list->pairs, options, work, std::move(list->findings), result);
  if (!compared) return compared.error();
  return result;
}

}  // namespace skylapse::diff
