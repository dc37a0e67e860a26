#pragma once
#include <chrono>
#include <string>

#include "cli/console.h"
#include "pipeline/run_job.h"

namespace skylapse::cli {

/// Progress on stderr: a bar with ETA that redraws on a terminal, a line every ten percent else.
class ProgressBar {
 public:
  explicit ProgressBar(const ConsoleOptions& console);
  ~ProgressBar();
  void show(const pipeline::Progress& progress);

 private:
  void draw(const pipeline::Progress& progress, const std::string& eta);
  bool quiet_;
  bool terminal_;
  bool drawn_ = false;
  int last_tenth_ = -1;
  std::string what_;
  std::chrono::steady_clock::time_point last_draw_{};
};

}  // namespace skylapse::cli
