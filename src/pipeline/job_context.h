#pragma once
// What all parts of a running job share.
#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "output/image_writer.h"
#include "pipeline/atmosphere_service.h"
#include "pipeline/frame_files.h"
#include "pipeline/ledger.h"
#include "pipeline/run_job.h"
#include "plan/plan.h"

namespace skylapse::pipeline {

struct JobContext {
  const plan::Plan& plan;
  const RunOptions& options;
  const output::ImageIo& io;
  const Displays& displays;
  Ledger& ledger;
  AtmosphereService& atmospheres;
  std::string color_config;  // hash
  std::chrono::steady_clock::time_point start;
  std::atomic<double>* frames_by_paths;  // finished, parts of frames included; not null

  [[nodiscard]] bool stopped() const {
    return options.stop_signal != nullptr && options.stop_signal->load() != 0;
  }
  /// What a frame that takes long calls with the share that is done: tells how far the job is,
  /// answers whether to go on.
  /// A frame of several pictures, each with shares of its own, is done when all of them are.
  [[nodiscard]] std::function<bool(double)> report_paths(int pictures = 1) const;
  [[nodiscard]] const plan::Frame& frame(long number) const { return plan.frames[number - 1]; }
  /// Fingerprint of one image output of a frame.
  [[nodiscard]] std::string fingerprint(const plan::Frame& frame, size_t output) const;
  /// True if every file of that output of the frame is finished.
  [[nodiscard]] bool finished(const plan::Frame& frame, size_t output) const;
  /// True if the ledger says so; the files are not read again.
  [[nodiscard]] bool recorded(const plan::Frame& frame, size_t output) const;
};

inline Error interrupted() {
  return {ErrorCode::interrupted,
          "interrupted: finished frames are kept",
          {},
          "run the same command again to go on"};
}

}  // namespace skylapse::pipeline
