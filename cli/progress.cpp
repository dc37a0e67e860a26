#include "cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include "cli/plan_text.h"

namespace skylapse::cli {

ProgressBar::ProgressBar(const ConsoleOptions& console)
    : quiet_(console.quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() {
  if (drawn_) std::fprintf(stderr, "\n");
}

void ProgressBar::show(const pipeline::Progress& progress) {
  if (quiet_ || progress.total == 0) return;
  if (progress.what != what_) {
    if (drawn_) std::fprintf(stderr, "\n");
    what_ = progress.what, last_tenth_ = -1, drawn_ = false;
  }
  const long made = progress.done - progress.kept;
  const bool last = progress.done == progress.total;
  const double left =
      made > 0 ? progress.seconds / double(made) * double(progress.total - progress.done) : 0;
  const std::string eta = last       ? "in " + duration_text(progress.seconds)
                          : made > 0 ? "ETA " + duration_text(left)
                                     : "";
  if (terminal_) {
    const auto now = std::chrono::steady_clock::now();
    if (!last && now - last_draw_ < std::chrono::milliseconds(100)) return;
    last_draw_ = now;
    draw(progress, eta);
    return;
  }
  const int tenth = int(10 * progress.done / progress.total);
  if (tenth == last_tenth_) return;
  last_tenth_ = tenth;
  std::fprintf(stderr, "%s: %ld of %ld  %s\n", progress.what.c_str(), progress.done, progress.total,
               eta.c_str());
}

void ProgressBar::draw(const pipeline::Progress& progress, const std::string& eta) {
  constexpr int kWidth = 30;
  const int filled = int(kWidth * progress.done / progress.total);
  const std::string kept = progress.kept > 0 ? fmt::format(", {} kept", progress.kept) : "";
  std::fprintf(stderr, "\r\033[K%s [%s%s] %ld/%ld%s  %s", progress.what.c_str(),
               std::string(filled, '=').c_str(), std::string(kWidth - filled, ' ').c_str(),
               progress.done, progress.total, kept.c_str(), eta.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace skylapse::cli
