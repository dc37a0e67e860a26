#pragma once
// One pair of files: read, checked, measured, judged.
#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "diff/diff_result.h"
#include "diff/facts.h"
#include "diff/limits.h"
#include "diff/pairs.h"
#include "image/diff/flip.h"
#include "image/diff/measure.h"

namespace skylapse::diff {

/// A measure chosen on the command line, in place of a profile: pixels whose error is above `fail`
/// may be no more than `percent` of all.
struct SimpleLimit {
  std::string metric = "relative";  // or "absolute", "display", "flip"
  double fail = kNone, warn = kNone;
  double percent = 0;
};

struct PairOptions {
  ReadLimits limits;
  bool flip = true;
  image::FlipOptions flip_options;
  std::optional<double> psnr_peak;
  // What files do not say of themselves:
  std::optional<image::Camera> camera;  // its size is that of the picture
  std::optional<Direction<Enu>> sun;
  std::optional<SimpleLimit> simple;
  const std::atomic<int>* stop_signal = nullptr;
};

/// What measures over time need of a pair; light enough to be kept for every frame.
struct PairTrace {
  bool valid = false;  // the pictures were compared
  bool display = false;
  bool identical = false;
  uint64_t hash_a = 0, hash_b = 0;
  std::vector<float> thumbnail_a, thumbnail_b;
  std::vector<image::Comparison::RegionLight> regions;
};

/// Never fails as a whole: an unreadable file is PairResult::error.
PairResult compare_pair(const FilePair& files, const Limits& limits, const PairOptions& options,
                        PairTrace* trace = nullptr);

}  // namespace skylapse::diff
