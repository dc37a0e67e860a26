#pragma once
#include <csignal>

namespace skylapse::output {

/// Holds back one synchronous signal of this thread (SIGXFSZ, SIGPIPE), so that the failing write
/// reports EFBIG or EPIPE instead of ending the process; one that arrived meanwhile is discarded.
/// The process's own signal settings are not touched.
class SignalGuard {
 public:
  explicit SignalGuard(int signal);
  ~SignalGuard();
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

 private:
  sigset_t set_{};
  sigset_t before_{};
  bool was_pending_ = false;
};

}  // namespace skylapse::output
