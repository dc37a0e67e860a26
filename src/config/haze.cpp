#include "config/haze.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/air_conversion.h"
#include "config/build_job.h"
#include "config/words.h"
#include "sky/cie/sky.h"
#include "sky/preetham/sky.h"

namespace skylapse::config {
namespace {

std::string length_text(Length length) {
  return length < 1.0 * km ? fmt::format("{:.0f} m", length.in(metre))
                           : fmt::format("{:.0f} km", length.in(km));
}

/// A range of turbidities in the terms of a key, rounded inwards.
std::string range_text(const TurbidityRange& range, std::string_view key) {
  if (key == "visibility")
    return fmt::format("{:.2f} km to {:.0f} km",
                       visibility_from_turbidity(range.highest).in(km) + 0.005,
                       visibility_from_turbidity(range.lowest).in(km)-0.5);
  if (key == "turbidity") return fmt::format("{} to {}", range.lowest, range.highest);
  return fmt::format("{:.4f} to {:.3f}", aerosol_depth_from_turbidity(range.lowest) + 5e-5,
                     aerosol_depth_from_turbidity(range.highest) - 5e-4);
}

/// Whether times without an offset have a zone, at every site.
bool zone_is_known(const Section& root, const std::vector<Site>& sites) {
  const auto time = only_section(root, "time");
  return (time && time->has("zone")) ||
         std::all_of(sites.begin(), sites.end(),
                     [](const Site& site) { return site.zone.has_value(); });
}

}  // namespace

TurbidityRange turbidity_range(SkyModel model) {
  if (model == SkyModel::preetham)
    return {sky::preetham::kLowestTurbidity, sky::preetham::kHighestTurbidity};
  if (model == SkyModel::cie) return {sky::cie::kLowestTurbidity, sky::cie::kHighestTurbidity};
  return {};
}

bool within_hosek_wilkie(double turbidity) {
  const TurbidityRange range = turbidity_range(SkyModel::hosek_wilkie);
  return turbidity >= range.lowest && turbidity <= range.highest;
}

bool HazeReader::is_covered() const {
  return model == SkyModel::cie && sky::cie::is_covered(cie_type);
}

std::optional<double> HazeReader::turbidity(const Section& section, std::string_view key,
                                            const Value& value) const {
  const double number = std::get<double>(value.data);
  const double depth = key == "turbidity"    ? aerosol_depth_from_turbidity(number)
                       : key == "visibility" ? aerosol_depth_from_visibility(number * metre, air)
                                             : number;
  if (depth < 0 && key != "turbidity") {
    context.errors.add(value.place,
                       fmt::format("{} is beyond that of air without haze", section.path_of(key)),
                       fmt::format("allowed: 200 m to {}", length_text(greatest_visibility(air))));
    return std::nullopt;
  }
  if (depth > sky::atmosphere::kMaxAerosolOpticalDepth) {
    context.errors.add(
        value.place,
        fmt::format("{} makes an aerosol optical depth of {:.3g}", section.path_of(key), depth),
        fmt::format("allowed: at most {}", sky::atmosphere::kMaxAerosolOpticalDepth));
    return std::nullopt;
  }
  const double turbidity = key == "turbidity" ? number : turbidity_from_aerosol_depth(depth);
  const TurbidityRange range = turbidity_range(model);
  if (!is_fitted(model) || (turbidity >= range.lowest && turbidity <= range.highest))
    return turbidity;
  context.errors.add(value.place,
                     fmt::format("{} is turbidity {:.3g}, beyond {}", section.path_of(key),
                                 turbidity, fitted_name(model)),
                     fmt::format("allowed: {}; or use sky.model bruneton", range_text(range, key)));
  return std::nullopt;
}

std::vector<AirKeyframe> build_keyframes(const Section& root, const Section& section,
                                         const Air& air, const std::vector<Site>& sites,
                                         const ReadContext& context) {
  std::vector<AirKeyframe> keyframes;
  const HazeReader haze{air.description, sky_model(root), cie_type(root), context};
  const bool zone_known = zone_is_known(root, sites);
  for (const auto& written : section.sections("keyframes")) {
    const auto time = written->get<TimeExpression>("time");
    if (!time) continue;
    AirKeyframe keyframe{*time, {air.description.aerosol_optical_depth, air.description.ozone_du}};
    keyframe.time.span = context.sources.span(written->place_of("time"));
    if (!time->utc_offset && !zone_known)
      context.errors.add(
          written->place_of("time"),
          fmt::format("{} has neither a time zone nor an offset", written->path_of("time")),
          "add \"zone: Europe/Prague\" (an IANA name, UTC or +02:00) to time or to "
          "the location");
    for (const std::string_view key : kHazeKeys)
      for (const Value& value : written->values(key)) {
        if (air.turbidity.size() > 1)
          context.errors.add(
              value.place,
              fmt::format("{} and a list of hazes exclude each other", written->path_of(key)),
              "give `air` one haze, or make a job for each");
        if (const auto turbidity = haze.turbidity(*written, key, value))
          keyframe.state.aerosol_optical_depth =
              std::max(0.0, aerosol_depth_from_turbidity(*turbidity));
      }
    keyframe.state.ozone_du = written->get<double>("ozone").value_or(keyframe.state.ozone_du);
    keyframes.push_back(keyframe);
  }
  return keyframes;
}

}  // namespace skylapse::config
