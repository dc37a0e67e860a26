#pragma once
// What a rung costs in a job, before the job is planned.
#include <vector>

#include "plan/picture_scenes.h"

namespace skylapse::plan {

/// Core seconds that the path tracer spends on a pixel before its first path (bench_reference).
inline constexpr double kPixelSetupSeconds = 0.0005;

/// Pixels and files of a frame, the same for every rung: the mean over the pictures.
double picture_seconds_of(const config::JobConfig& job, const std::vector<Picture>& pictures);

class RungCost {
 public:
  RungCost(const PromiseInputs& inputs, const std::vector<Picture>& pictures);

  /// Of a frame on average, its share of the tables included.
  [[nodiscard]] double core_seconds(const Rung& rung) const;

 private:
  double picture_seconds_ = 0;
  std::vector<sky::atmosphere::Medium> media_;  // whose tables are needed, in one band
  Angle lowest_sun_ = 90 * deg, highest_sun_ = -90 * deg;
  Length highest_camera_;
  double frames_ = 1;  // of the job, more than there are pictures where those are samples
};

}  // namespace skylapse::plan
