#pragma once
// Everything beyond the bare sky is an effect: on or off for each frame, with the reason.
#include <string>
#include <vector>

#include "plan/plan.h"

namespace skylapse::plan {

enum class Effect { sun_disc, ground, refraction, twilight_continuation };
std::string name_of(Effect effect);

struct EffectDecision {
  Effect effect;
  bool on = false;
  std::string reason;
};

/// Decisions for one frame, one per effect, in the order of the enum. An effect that is off
/// changes no pixel of the frame: the bound on the error of leaving it out is zero.
std::vector<EffectDecision> decide_effects(const config::JobConfig& job, const Frame& frame);

/// True if any part of the sun's disc falls into the picture and above the horizon.
bool sun_disc_in_view(const image::Camera& camera, const astro::SkyState& sky);

/// True if any pixel of the camera looks below the horizon.
bool ground_in_view(const image::Camera& camera);

}  // namespace skylapse::plan
