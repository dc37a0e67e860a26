#include "plan/sky_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "config/words.h"

namespace skylapse::plan {
namespace {

using config::SkyModel;

std::string place_of(const config::JobConfig& job, const SourceSpan& span) {
  return span.line > 0 ? fmt::format(" ({}:{})", job.file, span.line) : "";
}

/// Why the config alone rules Hosek-Wilkie out; nothing if it does not.
std::optional<std::string> reason_in_config(const config::JobConfig& job) {
  for (const auto* key : {&job.air.needs_atmosphere, &job.sky.needs_atmosphere})
    if (*key)
      return fmt::format("{}{} is known to a computed atmosphere only", (*key)->value,
                         place_of(job, (*key)->span));
  for (const config::Site& site : job.sites)
    if (site.position.height > kNearGround)
      return fmt::format("site '{}' is {:.0f} m high, and hosek-wilkie stands on the ground",
                         site.name, site.position.height.in(metre));
  for (const auto& turbidity : job.air.turbidity)
    if (!(turbidity.value >= 1 && turbidity.value <= 10))
      return fmt::format("turbidity {:.3g}{} is outside hosek-wilkie's 1 to 10", turbidity.value,
                         place_of(job, turbidity.span));
  return {};
}

/// The first moment at which the sun has set.
std::optional<std::string> reason_in_time(const config::JobConfig& job, const Schedule& schedule,
                                          const std::vector<astro::SkyState>& suns) {
  for (size_t i = 0; i < suns.size(); ++i) {
    const double el = elevation(suns[i].sun_apparent).in(deg);
    if (el >= 0) continue;
    return fmt::format("at {} ({}) the sun is at {:.2f} deg, and hosek-wilkie ends at the horizon",
                       format_local(schedule.times[i].local),
                       job.sites[schedule.times[i].site].name, el);
  }
  return {};
}

}  // namespace

std::string name_of(SkyModel model) {
  for (const auto& [word, value] : config::kSkyModelWords)
    if (value == model) return std::string(word);
  return "";
}

ModelChoice choose_model(const config::JobConfig& job, const Schedule& schedule,
                         const std::vector<astro::SkyState>& suns) {
  if (job.sky.model != SkyModel::automatic) return {job.sky.model, "asked for by sky.model"};
  if (auto reason = reason_in_config(job)) return {SkyModel::bruneton, *std::move(reason)};
  if (auto reason = reason_in_time(job, schedule, suns))
    return {SkyModel::bruneton, *std::move(reason)};
  return {SkyModel::hosek_wilkie,
          "the sun is up in every frame, every camera is near the ground, and the config asks for "
          "nothing else"};
}

Length camera_height(const config::Site& site) { return std::max(Length{}, site.position.height); }

Angle horizon_elevation(Length height, Length planet_radius) {
  const double r = planet_radius.in(km), h = height.in(km);
  return -atan2_angle(std::sqrt(h * (2 * r + h)), r);
}

astro::RefractionConditions refraction_at(const config::JobConfig& job, const config::Site& site,
                                          SkyModel model) {
  constexpr double kScaleHeightKm = 8.4;  // of the pressure near the ground, US standard atmosphere
  astro::RefractionConditions air = job.air.refraction;
  if (is_fitted(model) || job.air.observer_pressure_given || site.position.height <= kNearGround)
    return air;
  air.pressure *= std::exp(-site.position.height.in(km) / kScaleHeightKm);
  return air;
}

}  // namespace skylapse::plan
