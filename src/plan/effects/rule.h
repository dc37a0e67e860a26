#pragma once
// What a rule about an effect is, and the table of them all.
#include <optional>
#include <string>
#include <vector>

#include "sky/effects.h"

namespace skylapse::plan {

struct Frame;
struct Plan;
using sky::Effect;

/// An effect is left where this much or less of every pixel hangs on it. Errors of a pixel are the
/// largest difference of a channel over the largest channel of the pixel, or over the darkest step
/// of the display at the planned exposure (darkest_step) where the pixel is darker than that. A
/// thousandth moves an 8-bit value of the steepest view by a fifth of a step.
inline constexpr double kLeaveBelow = 1e-3;

/// What a rule finds.
struct Verdict {
  bool called_for = true;
  std::string reason;  // with the number that decided
  /// Greatest error of a pixel by leaving the effect out; nothing where no bound is known.
  std::optional<double> bound;
  double core_seconds = 0;  // that the effect costs the frame
  /// False: nothing can turn it on, neither `all` nor a list (a key that switches it off, a model
  /// that lacks it).
  bool possible = true;
};

/// How an effect is decided. `known`: whether the plan's model has it. `judge`: pure; the frame is
/// one of the plan's, with sun, horizon and exposure set.
struct EffectRule {
  Effect effect;
  bool (*known)(const Plan& plan);
  Verdict (*judge)(const Plan& plan, const Frame& frame);
};
using EffectRules = std::vector<EffectRule>;

/// One rule for each effect, in the order of the enum. A plan takes another table in tests only.
const EffectRules& standard_rules();

/// The rules, each in a file of its name. Those of `Whole jobs` answer the same for every frame.
Verdict judge_sun_disc(const Plan& plan, const Frame& frame);
Verdict judge_limb_darkening(const Plan& plan, const Frame& frame);
Verdict judge_refraction(const Plan& plan, const Frame& frame);
Verdict judge_flattening(const Plan& plan, const Frame& frame);
Verdict judge_multiple_scattering(const Plan& plan, const Frame& frame);
Verdict judge_ground(const Plan& plan, const Frame& frame);
Verdict judge_aerial_perspective(const Plan& plan, const Frame& frame);
Verdict judge_unseen_sky(const Plan& plan, const Frame& frame);
Verdict judge_twilight_continuation(const Plan& plan, const Frame& frame);
// Whole jobs: what tables are made of, and what no sequence may change on its way.
Verdict judge_ozone(const Plan& plan, const Frame& frame);
Verdict judge_aerosol(const Plan& plan, const Frame& frame);
Verdict judge_further_orders(const Plan& plan, const Frame& frame);
Verdict judge_full_tables(const Plan& plan, const Frame& frame);
Verdict judge_full_spectrum(const Plan& plan, const Frame& frame);

}  // namespace skylapse::plan
