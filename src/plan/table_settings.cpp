#include "plan/table_settings.h"

#include <algorithm>

#include "plan/effects/calibrated_bounds.h"
#include "plan/plan.h"
#include "sky/bruneton/sun_range.h"

namespace skylapse::plan {
namespace {

using sky::Effect;
using sky::bruneton::Settings;

/// Sizes that suffice for both: tables that are mixed must be alike.
Settings larger(Settings a, const Settings& b) {
  for (int Settings::*size :
       {&Settings::heights, &Settings::suns, &Settings::sun_rows_per_interval,
        &Settings::directions_up, &Settings::directions_down, &Settings::azimuths,
        &Settings::harmonics, &Settings::table_azimuths, &Settings::table_zeniths,
        &Settings::samples, &Settings::first_order_samples, &Settings::max_orders})
    a.*size = std::max(a.*size, b.*size);
  a.stop_below = std::min(a.stop_below, b.stop_below);
  return a;
}

}  // namespace

bool reads_tables(const Plan& plan, sky::EffectSet effects) {
  return plan.model == config::SkyModel::bruneton && plan.job.sky.orders != 1 &&
         effects.has(Effect::multiple_scattering);
}

Settings table_settings(const Plan& plan, const TableMedia& media, sky::EffectSet effects) {
  const config::Sky& sky = plan.job.sky;
  Settings settings = settings_for(sky.level, media.a);
  if (media.weight > 0) settings = larger(settings, settings_for(sky.level, media.b));
  settings.orders = sky.orders;
  if (effects.has(Effect::further_orders))
    settings.stop_below = std::min(settings.stop_below, kFurtherOrdersStop);
  if (effects.has(Effect::full_tables)) return settings;
  const Reach& reach = plan.reach;
  return restricted_to(
      sky::bruneton::sun_range_for(media.a, 90 * deg - reach.highest_sun,
                                   90 * deg - reach.lowest_sun, reach.highest_camera),
      settings, media.a);
}

}  // namespace skylapse::plan
