#include "output/signal_guard.h"

#include <ctime>

namespace skylapse::output {

SignalGuard::SignalGuard(int signal) {
  sigset_t pending;
  sigpending(&pending);
  was_pending_ = sigismember(&pending, signal) == 1;
  sigemptyset(&set_);
  sigaddset(&set_, signal);
  pthread_sigmask(SIG_BLOCK, &set_, &before_);
}

SignalGuard::~SignalGuard() {
  // A signal that waited before us belongs to somebody else and stays.
  const timespec at_once{};
  if (!was_pending_) sigtimedwait(&set_, nullptr, &at_once);
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace skylapse::output
