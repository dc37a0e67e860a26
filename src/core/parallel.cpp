#include "core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

// ThreadSanitizer does not see how the library, which is not instrumented, hands work over and
// back: what was written before a loop is seen by its pieces, and what these write after it.
#if defined(__SANITIZE_THREAD__)
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace skylapse {
namespace {

void come_after([[maybe_unused]] void* moment) {
#if defined(__SANITIZE_THREAD__)
  __tsan_acquire(moment);
#endif
}

void come_before([[maybe_unused]] void* moment) {
#if defined(__SANITIZE_THREAD__)
  __tsan_release(moment);
#endif
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
  char begun = 0, ended = 0;  // their addresses stand for the two moments
  come_before(&begun);
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, count, grain > 0 ? grain : 1),
                      [&](const auto& range) {
                        come_after(&begun);
                        body(range.begin(), range.end());
                        come_before(&ended);
                      });
  });
  come_after(&ended);
}

ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0)
    control_ = new tbb::global_control(tbb::global_control::max_allowed_parallelism, threads);
}

ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }

}  // namespace skylapse
