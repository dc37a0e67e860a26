#include "plan/exposure_plan.h"

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "color/exposure.h"
#include "core/constants.h"
#include "plan/baseline_of_frame.h"
#include "plan/sky_of_frame.h"
#include "sky/bruneton/twin.h"
#include "sky/twilight.h"

namespace skylapse::plan {

using sky::bruneton::Twin;

namespace {

/// The meter's EV of every frame, then followed inside each sequence.
Status plan_metered(Plan& plan) {
  const color::ExposureSettings& settings = plan.job.exposure;
  SkyMeter sky(plan);
  size_t begin = 0;
  while (begin < plan.frames.size()) {
    std::vector<color::MeteredFrame> meter;
    size_t end = begin;
    // Skies by the sun's elevation are pictures of their own, not a film.
    const bool alone = plan.frames[begin].asked_sun.has_value();
    for (; end < plan.frames.size() && plan.frames[end].sequence == plan.frames[begin].sequence &&
           !(alone && end > begin);
         ++end) {
      auto light = sky.read(plan.frames[end]);
      if (!light) return light.error();
      const Duration since = plan.frames[end].instant - plan.frames[begin].instant;
      meter.push_back({since, color::metered_ev(*light)});
    }
    const auto evs = color::follow_meter(meter, settings.rate_limit);
    for (size_t i = begin; i < end; ++i) plan.frames[i].ev = evs[i - begin] - settings.compensation;
    begin = end;
  }
  return Done{};
}

/// The clear sky that the sun curve exposes for: a function of the sun's elevation over the horizon
/// that the camera sees, which fades as the picture does, so that its brightness follows smoothly.
Luminance clear_sky_of(const Plan& plan, const Frame& frame) {
  const Angle over = elevation(frame.sky.sun_apparent) - frame.horizon;
  if (!is_fitted(plan.model)) return sky::mean_computed_sky_luminance(over);
  const Luminance sky = sky::mean_clear_sky_luminance(frame.sun.elevation);
  if (!frame.sun.extrapolated) return sky;
  const Illuminance at_horizon = std::numbers::pi * sky.in(cd_per_m2)*lux;
  return sky * sky::twilight_level(elevation(frame.sky.sun_true),
                                   true_elevation_of_apparent_horizon(plan.job.air.refraction),
                                   at_horizon);
}

}  // namespace

/// Twins of the media of the plan, in few bands.
struct SkyMeter::Air {
  config::JobConfig coarse;
  bool single_scattering = false;
  std::map<std::string, std::shared_ptr<const Twin>> twins;

  const Twin& twin_of(const sky::atmosphere::Medium& medium) {
    auto& twin = twins[canonical_text(medium)];
    if (twin) return *twin;
    sky::bruneton::Tables tables;
    tables.medium = medium;
    if (!single_scattering)
      tables = precompute_twin(medium, settings_for(sky::bruneton::Level::draft, medium));
    twin = std::make_shared<const Twin>(
        std::make_shared<const sky::bruneton::Tables>(std::move(tables)));
    return *twin;
  }

  /// Horizontal Y by the sky at 1 au.
  double sky_y(const sky::atmosphere::Medium& medium, const Frame& frame) {
    const auto bands = twin_of(medium).irradiance(Length{}, 90 * deg - frame.sun.elevation).sky;
    double y = 0;
    for (size_t b = 0; b < bands.size(); ++b) y += bands[b] * medium.bands[b].xyz_weight.y;
    return y;
  }
};

SkyMeter::SkyMeter(const Plan& plan) : plan_(plan), air_(std::make_unique<Air>()) {
  if (is_fitted(plan.model)) return;
  air_->coarse = plan.job;
  air_->coarse.sky.wavelengths = kMeterBands;
  air_->single_scattering = plan.model == config::SkyModel::single_scattering;
}

SkyMeter::~SkyMeter() = default;

Result<Luminance> SkyMeter::read(const Frame& frame) {
  const double level = frame.sun.twilight_level * frame.sun.distance_factor;
  const auto luminance = [&](double sky_y) {
    return kLuminousEfficacy * sky_y * level / std::numbers::pi * cd_per_m2;
  };
  if (is_baseline(plan_.model)) {
    const auto sky = baseline_of_frame(plan_.job, plan_.model, frame);
    if (!sky) return sky.error();
    return luminance(sky::dome_irradiance(sky->dome).y);
  }
  if (is_fitted(plan_.model)) {
    const auto sky = sky_of_frame(plan_.job, frame);
    if (!sky) return sky.error();
    return luminance(sky->diffuse_irradiance_xyz().y);
  }
  const auto media = tables_of_frame(air_->coarse, plan_.air, frame);
  if (!media) return media.error();
  double y = air_->sky_y(media->a, frame);
  if (media->weight > 0) y = std::lerp(y, air_->sky_y(media->b, frame), media->weight);
  return luminance(y);
}

Status plan_exposure(Plan& plan) {
  const color::ExposureSettings& settings = plan.job.exposure;
  if (settings.mode == color::ExposureMode::metered) return plan_metered(plan);
  for (Frame& frame : plan.frames) {
    frame.ev = settings.ev;
    if (settings.mode == color::ExposureMode::sun_curve)
      frame.ev = color::sun_curve_ev(clear_sky_of(plan, frame));
    frame.ev -= settings.compensation;
  }
  return Done{};
}

}  // namespace skylapse::plan
