#pragma once
// Exposure in EV at ISO 100, planned before anything is rendered.
#include <vector>

#include "core/quantity.h"

namespace skylapse::color {

enum class ExposureMode { fixed, sun_curve, metered };

struct ExposureSettings {
  ExposureMode mode = ExposureMode::sun_curve;
  double ev = 15.0;            // EV100 in mode fixed
  double compensation = 0.0;   // stops; positive is brighter
  double rate_limit = 0.5;     // metered: greatest change in stops per minute
};

}  // namespace skylapse::color
