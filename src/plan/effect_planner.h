#pragma once
// Everything beyond the bare sky is an effect: taken or left for each frame, with the reason.
#include <optional>
#include <string>
#include <vector>

#include "plan/effects/rule.h"
#include "plan/plan.h"

namespace skylapse::plan {

struct EffectDecision {
  Effect effect;
  bool on = false;
  std::string reason;
  /// Off: greatest error of a pixel by leaving it out (kLeaveBelow says how that is measured);
  /// nothing where none is known, because the config left it out and not the planner.
  std::optional<double> error_bound;
  double core_seconds = 0;  // that it costs the frame, or would
};

/// Decisions for one frame in the order of the enum, one per effect that the plan's model knows:
/// what the plan's rules find under `sky.effects: auto`; all that is possible under `all`; under a
/// list what it names and no others.
std::vector<EffectDecision> decide_effects(const Plan& plan, const Frame& frame);

/// The decision on one effect; nothing if the model does not know it.
std::optional<EffectDecision> decide_effect(const Plan& plan, const Frame& frame, Effect effect);

/// The effects that are on: what the pipeline asks.
sky::EffectSet effects_of(const Plan& plan, const Frame& frame);

/// True if any part of the sun's disc falls into the picture and above the horizon.
bool sun_disc_in_view(const Sight& sight, const astro::SkyState& sky, Angle horizon = {});

/// True if any pixel of the camera looks below the horizon.
bool ground_in_view(const image::Camera& camera, Angle horizon = {});

}  // namespace skylapse::plan
