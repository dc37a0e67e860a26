#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "plan/plan.h"
#include "sky/atmosphere/medium.h"
#include "sky/atmosphere_disc.h"

namespace skylapse::pipeline {

/// The sun's disc of a frame, seen through the air of `medium`; nothing while it is below the
/// horizon. `transmittance`: per band, from the camera towards a zenith angle.
std::optional<sky::AtmosphereDisc> disc_of_frame(
    const sky::atmosphere::Medium& medium, const plan::Frame& frame,
    const std::function<std::vector<double>(Angle zenith)>& transmittance);

}  // namespace skylapse::pipeline
