#include "core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/thread_order.h"

namespace skylapse {
namespace {

/// One parallel loop: what was written before it is seen by its pieces, and what these write after.
struct Loop {
  const std::function<void(size_t, size_t)>& body;
  Moment begun, ended;
};

[[gnu::noinline]] void run_piece(Loop& loop, size_t begin, size_t end) {
  loop.begun.passed();
  loop.body(begin, end);
  loop.ended.reached();
}

}  // namespace

int available_cores() { return tbb::info::default_concurrency(); }

int allowed_threads() {
  return int(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

void parallel_for_ranges(size_t count, size_t grain,
                         const std::function<void(size_t, size_t)>& body) {
  // Isolated: while this thread waits for its pieces it must not start on another frame, which
  // would hold two frames on one thread and count the one's time as the other's.
  Loop loop{body, {}, {}};
  loop.begun.reached();
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, count, grain > 0 ? grain : 1),
                      [&loop](const auto& range)
                          SKYLAPSE_UNWATCHED { run_piece(loop, range.begin(), range.end()); });
  });
  loop.ended.passed();
}

ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0)
    control_ = new tbb::global_control(tbb::global_control::max_allowed_parallelism, threads);
}

ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }

}  // namespace skylapse
