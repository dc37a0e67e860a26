#pragma once
// Measured scenes as lines of a CSV file that grows: a calibration can be stopped and taken up.
#include <string>
#include <vector>

#include "core/result.h"
#include "study/scene_errors.h"

namespace skylapse::study {

struct MeasuredScene {
  uint64_t seed = 0;
  int index = 0;
  AccuracyScene scene;
  SceneErrors errors;
};

/// Header line and one line a scene, without line ends. Values that do not exist are empty.
std::string measured_header();
std::string measured_line(const MeasuredScene& measured);

/// Reads what measured_line wrote; the scene is drawn again from seed and index.
Result<std::vector<MeasuredScene>> read_measured(const std::string& path);

}  // namespace skylapse::study
