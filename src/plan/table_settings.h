#pragma once
// Sizes of the multiple-scattering tables that a job's frames read: by the keys of the sky, and by
// the effects that are on.
#include "plan/atmosphere_of_frame.h"
#include "sky/bruneton/settings.h"
#include "sky/effects.h"

namespace skylapse::plan {

struct Plan;

/// Whether frames of this plan and these effects read tables at all. False for the first order
/// alone: model single-scattering, sky.orders 1, or an effect that is off.
bool reads_tables(const Plan& plan, sky::EffectSet effects);

/// Settings that suffice for both media, which are mixed: the job's level, raised where one of them
/// needs it; sky.orders; more orders under further_orders; and without full_tables the suns alone
/// that frames of the whole job read (sky::bruneton::sun_range_for has the bound), however few of
/// them a run renders. The same for every frame of an air.
sky::bruneton::Settings table_settings(const Plan& plan, const TableMedia& media,
                                       sky::EffectSet effects);

}  // namespace skylapse::plan
