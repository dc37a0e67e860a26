#include "plan/effects/rule.h"
#include "plan/plan.h"

namespace skylapse::plan {
namespace {

bool always(const Plan&) { return true; }
bool computed(const Plan& plan) { return !is_fitted(plan.model); }
bool with_slices(const Plan& plan) {
  return plan.model == config::SkyModel::bruneton ||
         plan.model == config::SkyModel::single_scattering;
}
bool with_tables(const Plan& plan) { return plan.model == config::SkyModel::bruneton; }
bool hosek_wilkie(const Plan& plan) {
  return plan.model == config::SkyModel::hosek_wilkie ||
         plan.model == config::SkyModel::hosek_wilkie_gl;
}

}  // namespace

const EffectRules& standard_rules() {
  static const EffectRules kRules{
      {Effect::sun_disc, always, judge_sun_disc},
      {Effect::limb_darkening, always, judge_limb_darkening},
      {Effect::refraction, always, judge_refraction},
      {Effect::flattening, always, judge_flattening},
      {Effect::ozone, computed, judge_ozone},
      {Effect::aerosol, computed, judge_aerosol},
      {Effect::multiple_scattering, computed, judge_multiple_scattering},
      {Effect::further_orders, with_tables, judge_further_orders},
      {Effect::ground, always, judge_ground},
      {Effect::aerial_perspective, computed, judge_aerial_perspective},
      {Effect::unseen_sky, with_slices, judge_unseen_sky},
      {Effect::full_tables, with_tables, judge_full_tables},
      {Effect::full_spectrum, computed, judge_full_spectrum},
      {Effect::twilight_continuation, hosek_wilkie, judge_twilight_continuation},
  };
  return kRules;
}

}  // namespace skylapse::plan
