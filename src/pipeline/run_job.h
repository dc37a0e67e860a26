#pragma once
// Runs a plan: frames overlap on all cores, finished ones are kept, the rest is made.
#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "gpu/context.h"
#include "pipeline/stage_times.h"
#include "plan/plan.h"
#include "plan/work_list.h"

namespace skylapse::pipeline {

struct Progress {
  long done = 0, total = 0;  // frames, kept ones included
  long kept = 0;
  double seconds = 0;  // since the start
  std::string what;    // "frames", "atmosphere %" (of 100) or the movie's name
};

struct RunOptions {
  std::filesystem::path output = "out";
  std::vector<long> frames;  // numbers from 1, ascending
  plan::Shard shard;
  bool overwrite = false;                            // render all, whatever is there
  int jobs = 0;                                      // threads; 0: all cores
  gpu::Backend backend = gpu::Backend::automatic;    // of models that compute the atmosphere
  const std::atomic<int>* stop_signal = nullptr;     // not 0: stop soon
  std::function<void(const Progress&)> on_progress;  // one call at a time, from any thread
};

struct RunSummary {
  long rendered = 0, kept = 0;
  uintmax_t bytes_written = 0;
  StageTimes times;  // summed over frames; sky is core time, others wall time of one thread
  double seconds = 0;
  double movie_seconds = 0, library_seconds = 0;
  bool complete = false;  // every frame of the job is there, other shards included
  std::vector<std::string> notes;
};

/// Renders what is missing, then the movies if all their frames are there, then the manifest.
/// On an error or a stop signal the finished frames stay and are recorded; the error is returned
/// (ErrorCode::interrupted for a signal).
Result<RunSummary> run_job(const plan::Plan& plan, const RunOptions& options);

/// Frames that may be in memory at once: enough for all threads, within 1.5 GiB of pixels.
int frames_in_flight(const plan::Plan& plan, int threads);
/// Bytes of their pixels, at most.
double picture_memory(const plan::Plan& plan, int threads);

}  // namespace skylapse::pipeline
