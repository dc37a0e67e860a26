#include "cli/signals.h"

#include <csignal>

namespace skylapse::cli {

std::atomic<int> g_signal = 0;

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = [](int signal) { g_signal = signal; };
  action.sa_flags = SA_RESETHAND;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace skylapse::cli
