#include "plan/exposure_plan.h"

#include <algorithm>
#include <numbers>

#include "color/exposure.h"
#include "core/constants.h"
#include "plan/sky_of_frame.h"
#include "sky/twilight.h"

namespace skylapse::plan {
namespace {

/// The meter's EV of every frame, then followed inside each sequence.
Status plan_metered(Plan& plan) {
  const color::ExposureSettings& settings = plan.job.exposure;
  size_t begin = 0;
  while (begin < plan.frames.size()) {
    std::vector<color::MeteredFrame> meter;
    size_t end = begin;
    for (; end < plan.frames.size() && plan.frames[end].sequence == plan.frames[begin].sequence;
         ++end) {
      auto light = model_sky_luminance(plan.job, plan.frames[end]);
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
/// that the camera sees, continued below it as light fades on the ground, so that the picture's
/// brightness follows smoothly.
Luminance clear_sky_of(const config::JobConfig& job, const Frame& frame) {
  const Angle over = elevation(frame.sky.sun_apparent) - frame.horizon;
  const Luminance sky = sky::mean_clear_sky_luminance(std::clamp(over, 0 * deg, 90 * deg));
  if (over >= 0 * deg) return sky;
  const Illuminance at_horizon = std::numbers::pi * sky.in(cd_per_m2)*lux;
  return sky * sky::twilight_level(elevation(frame.sky.sun_true) - frame.horizon,
                                   true_elevation_of_apparent_horizon(job.air.refraction),
                                   at_horizon);
}

}  // namespace

Result<Luminance> model_sky_luminance(const config::JobConfig& job, const Frame& frame) {
  const auto sky = sky_of_frame(job, frame);
  if (!sky) return sky.error();
  const double level = frame.sun.twilight_level * frame.sun.distance_factor;
  const double illuminance = kLuminousEfficacy * sky->diffuse_irradiance_xyz().y * level;
  return illuminance / std::numbers::pi * cd_per_m2;
}

Status plan_exposure(Plan& plan) {
  const color::ExposureSettings& settings = plan.job.exposure;
  if (settings.mode == color::ExposureMode::metered) return plan_metered(plan);
  for (Frame& frame : plan.frames) {
    frame.ev = settings.ev;
    if (settings.mode == color::ExposureMode::sun_curve)
      frame.ev = color::sun_curve_ev(clear_sky_of(plan.job, frame));
    frame.ev -= settings.compensation;
  }
  return Done{};
}

}  // namespace skylapse::plan
