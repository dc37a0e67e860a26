#pragma once
// Threads, through oneTBB. Results never depend on the number of threads.
#include <cstddef>
#include <functional>

namespace skylapse {

/// Cores this process may use (affinity and cgroup respected by the scheduler).
int available_cores();

/// Threads that parallel work of this process may use now: available_cores() or the ThreadLimit.
int allowed_threads();

/// Calls body(begin, end) over disjoint pieces that cover [0, count), on all cores.
/// Pieces hold at least `grain` items. The body must not throw.
void parallel_for_ranges(size_t count, size_t grain,
                         const std::function<void(size_t begin, size_t end)>& body);

/// Limits the whole process to `threads` worker threads while alive; 0 means no limit.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_ = nullptr;
};

}  // namespace skylapse
