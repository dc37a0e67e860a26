#include "plan/rates.h"

#include <algorithm>

#include "plan/plan.h"

namespace skylapse::plan::rates {
namespace {

constexpr double kSliceGroupSeconds = 0.015;  // of four wavelengths, 64 x 128 directions
// Of a slice without multiple scattering, and of tables with more orders or all suns, over one
// with or as usual (bench_effects).
constexpr double kMultipleShareOfSlice = 0.4, kFurtherOrders = 0.8;

double groups(const Plan& plan) { return (plan.job.sky.wavelengths + 3) / 4; }
double per_frame(const Plan& plan) { return 1.0 / double(std::max<size_t>(1, plan.frames.size())); }

/// Core seconds to compute the tables of four wavelengths on software GL, shaders compiled.
double table_group_seconds(sky::bruneton::Level level) {
  switch (level) {
    case sky::bruneton::Level::draft:
      return 0.1;
    case sky::bruneton::Level::low:
      return 0.3;
    case sky::bruneton::Level::standard:
      return 0.55;
    case sky::bruneton::Level::fine:
      return 2.2;
  }
  return 0;
}

}  // namespace

double table_seconds(const Plan& plan, const sky::bruneton::Settings& s) {
  constexpr double kFixed = 0.22;     // of all suns' time
  constexpr double kUsualOrders = 8;  // until they converge in clear air
  double share = kFixed + (1 - kFixed) * s.suns / std::max(1, s.warp_suns());
  if (s.orders > 0) share *= 0.3 + 0.7 * std::min(2.0, s.orders / kUsualOrders);
  if (s.stop_below < 0.5 * stop_below(plan.job.sky.level)) share *= 1 + kFurtherOrders;
  return share * table_seconds(plan);
}

double frame_slice_seconds(const Plan& plan, const Frame& frame, sky::EffectSet effects) {
  constexpr double kUsualDirections = 64 * 128, kUsualSteps = 16;
  constexpr double kIrradianceShare = 0.1;  // a small slice of its own, for the manifest
  const config::Sky& sky = plan.job.sky;
  double seconds = slice_seconds(plan);
  if (sky.slice_azimuths > 0)
    seconds *= double(sky.slice_azimuths) * sky.slice_zeniths / kUsualDirections;
  if (sky.steps > 0) seconds *= sky.steps / kUsualSteps;
  if (!effects.has(sky::Effect::multiple_scattering)) seconds *= 1 - kMultipleShareOfSlice;
  double seen = 1;
  if (!effects.has(sky::Effect::unseen_sky)) {
    const ViewReach& view = plan.views[frame.camera];
    const Angle below = std::clamp(frame.horizon - view.lowest, 0 * deg, 90 * deg);
    const Angle above = std::clamp(view.highest - frame.horizon, 0 * deg, 90 * deg);
    seen = (below + above) / (180 * deg);
    const image::Camera* camera = plan.sights[frame.camera].only_picture();
    // Both sides of the sun are one; towards the zenith all azimuths are near.
    if (camera != nullptr && camera->projection == image::Projection::perspective &&
        view.highest < 80 * deg)
      seen *= std::min(1.0, 1.5 * camera->field_of_view.in(deg) / 180);
  }
  return seconds * (kIrradianceShare + (1 - kIrradianceShare) * seen);
}

double slice_seconds(const Plan& plan) { return kSliceGroupSeconds * groups(plan); }

double table_seconds(const Plan& plan) {
  return table_group_seconds(plan.job.sky.level) * groups(plan);
}

double multiple_scattering_seconds(const Plan& plan) {
  return table_seconds(plan) * per_frame(plan) + kMultipleShareOfSlice * slice_seconds(plan);
}

double further_orders_seconds(const Plan& plan) {
  return kFurtherOrders * table_seconds(plan) * per_frame(plan);
}

double full_tables_seconds(const Plan& plan) { return table_seconds(plan) * per_frame(plan) / 2; }

double full_spectrum_seconds(const Plan& plan) {
  return table_seconds(plan) * per_frame(plan) + slice_seconds(plan);
}

double stop_below(sky::bruneton::Level level) {
  return sky::bruneton::settings_for(level, sky::atmosphere::Medium{}).stop_below;
}

}  // namespace skylapse::plan::rates
