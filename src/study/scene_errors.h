#pragma once
// The parts of the error of one scene, measured: what calibration is made from.
#include <array>
#include <optional>

#include "plan/error_parts.h"
#include "plan/sky_parts.h"
#include "study/accuracy_scene.h"

namespace skylapse::study {

/// Mean square of the relative error over the directions of a part of the sky, without bias from
/// the noise of the truth (so it may be negative), and the standard error of that mean.
struct MeanSquare {
  double value = 0, uncertainty = 0;
};

struct SceneErrors {
  /// [error part][sky part]; nothing where the scene has no such part (no aureole at night, no
  /// Hosek-Wilkie with the sun below the horizon).
  std::array<std::array<std::optional<MeanSquare>, plan::kSkyParts>, plan::kErrorParts> parts;
  double core_seconds = 0;  // that the measurement took
};

struct MeasureOptions {
  int directions = 16;  // in each part of the sky, of the comparisons of models
  int traced = 8;       // of these, also traced
  long paths = 2500;    // twice that many for each traced direction
  uint64_t seed = 1;    // of the paths
  bool tables =
      true;  // false: only Hosek-Wilkie, single scattering and bands, in a third of the time
};

/// Measures the parts by the CPU twin in double and, for `fine`, by the path tracer: light of two
/// and more orders traced twice with other random numbers, the products of the two differences
/// averaged, the first order integrated. All cores.
SceneErrors measure_scene(const AccuracyScene& scene, const MeasureOptions& options = {});

}  // namespace skylapse::study
