#pragma once
// Stop signals, for commands that end in good order.
#include <atomic>

namespace skylapse::cli {

/// The signal that arrived, or 0: the only thing the handler touches.
extern std::atomic<int> g_signal;

/// SIGINT and SIGTERM are noted in g_signal; a second one ends the process at once.
void catch_signals();

}  // namespace skylapse::cli
