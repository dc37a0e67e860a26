#include "plan/effect_planner.h"

#include <algorithm>

namespace skylapse::plan {
namespace {

using Rule = config::EffectChoice::Rule;

EffectDecision decide(const EffectRule& rule, const Plan& plan, const Frame& frame) {
  Verdict verdict = rule.judge(plan, frame);
  EffectDecision decision{rule.effect, verdict.called_for && verdict.possible,
                          std::move(verdict.reason), verdict.bound, verdict.core_seconds};
  const config::EffectChoice& choice = plan.job.sky.effects;
  if (!verdict.possible || choice.rule == Rule::automatic) return decision;
  const bool listed =
      std::find(choice.listed.begin(), choice.listed.end(), rule.effect) != choice.listed.end();
  decision.on = choice.rule == Rule::all || listed;
  if (decision.on && !verdict.called_for)
    decision.reason = "asked for by sky.effects, though " + decision.reason;
  if (!decision.on && verdict.called_for)
    decision.reason = "not among sky.effects, though " + decision.reason;
  return decision;
}

}  // namespace

bool sun_disc_in_view(const Sight& sight, const astro::SkyState& sky, Angle horizon) {
  if (elevation(sky.sun_apparent) + sky.sun_radius <= horizon) return false;
  // A disc smaller than a pixel spreads over its neighbours.
  return sight.sees_disc(sky.sun_apparent, sky.sun_radius, 2);
}

bool ground_in_view(const image::Camera& camera, Angle horizon) {
  return view_reach(camera).lowest < horizon;
}

std::vector<EffectDecision> decide_effects(const Plan& plan, const Frame& frame) {
  std::vector<EffectDecision> decisions;
  for (const EffectRule& rule : *plan.rules)
    if (rule.known(plan)) decisions.push_back(decide(rule, plan, frame));
  return decisions;
}

std::optional<EffectDecision> decide_effect(const Plan& plan, const Frame& frame, Effect effect) {
  for (const EffectRule& rule : *plan.rules)
    if (rule.effect == effect && rule.known(plan)) return decide(rule, plan, frame);
  return {};
}

sky::EffectSet effects_of(const Plan& plan, const Frame& frame) {
  sky::EffectSet set;
  for (const EffectRule& rule : *plan.rules)
    if (rule.known(plan)) set.set(rule.effect, decide(rule, plan, frame).on);
  return set;
}

}  // namespace skylapse::plan
