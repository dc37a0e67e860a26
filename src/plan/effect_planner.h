#pragma once
// Everything beyond the bare sky is an effect: on or off for each frame, with the reason.
#include <optional>
#include <string>
#include <vector>

#include "plan/plan.h"
#include "sky/effects.h"

namespace skylapse::plan {

using sky::Effect;

struct EffectDecision {
  Effect effect;
  bool on = false;
  std::string reason;
  /// Off: greatest relative error of a pixel by leaving it out; nothing where no bound is known,
  /// because the config left it out and not the planner.
  std::optional<double> error_bound = 0.0;
};

/// Decisions for one frame in the order of the enum, one per effect that the plan's model knows:
/// twilight_continuation is Hosek-Wilkie's, multiple_scattering that of the computed atmospheres.
/// An effect that the planner leaves out changes no pixel of the frame.
std::vector<EffectDecision> decide_effects(const Plan& plan, const Frame& frame);

/// True if any part of the sun's disc falls into the picture and above the horizon.
bool sun_disc_in_view(const image::Camera& camera, const astro::SkyState& sky, Angle horizon = {});

/// True if any pixel of the camera looks below the horizon.
bool ground_in_view(const image::Camera& camera, Angle horizon = {});

}  // namespace skylapse::plan
