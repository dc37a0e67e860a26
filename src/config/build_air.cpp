#include <fmt/format.h>

#include <filesystem>

#include "config/air_conversion.h"
#include "config/build_job.h"
#include "config/words.h"

namespace skylapse::config {
namespace {

constexpr double kLowestTurbidity = 1, kHighestTurbidity = 10;  // as in the table of keys

/// Reports a converted turbidity outside the range; `allowed` is that range in the user's terms.
bool within_models(double turbidity, const Section& air, std::string_view key, const Value& value,
                   const std::string& allowed, const ReadContext& context) {
  if (turbidity >= kLowestTurbidity && turbidity <= kHighestTurbidity) return true;
  context.errors.add(
      value.place,
      fmt::format("{} is turbidity {:.3g}, beyond the sky models", air.path_of(key), turbidity),
      fmt::format("allowed: {}", allowed));
  return false;
}

void add_turbidities(const Section& air, std::vector<Spanned<double>>& list,
                     const ReadContext& context) {
  const auto add = [&](double turbidity, const Value& value) {
    list.push_back({turbidity, context.sources.span(value.place)});
  };
  for (const Value& value : air.values("turbidity")) add(std::get<double>(value.data), value);
  for (const Value& value : air.values("visibility")) {
    const double turbidity = turbidity_from_visibility(std::get<double>(value.data) * metre);
    const std::string allowed =
        fmt::format("{:.2f} km to {:.0f} km", visibility_from_turbidity(10).in(km) + 0.005,
                    visibility_from_turbidity(1).in(km)-0.5);
    if (within_models(turbidity, air, "visibility", value, allowed, context)) add(turbidity, value);
  }
  for (const Value& value : air.values("aerosol_optical_depth")) {
    const double turbidity = turbidity_from_aerosol_depth(std::get<double>(value.data));
    const std::string allowed =
        fmt::format("{:.4f} to {:.3f}", aerosol_depth_from_turbidity(1) + 5e-5,
                    aerosol_depth_from_turbidity(10) - 5e-4);
    if (within_models(turbidity, air, "aerosol_optical_depth", value, allowed, context))
      add(turbidity, value);
  }
}

template <class T>
void refuse_twice(const Section& air, std::string_view key, const std::vector<Spanned<T>>& list,
                  const auto& same, const ReadContext& context) {
  for (size_t i = 0; i < list.size() && list.size() == air.values(key).size() && i < 1000; ++i)
    for (size_t j = 0; j < i; ++j)
      if (same(list[i].value, list[j].value)) {
        context.errors.add(air.values(key)[i].place,
                           fmt::format("{} lists the same value twice", air.path_of(key)));
        break;
      }
}

}  // namespace

Air build_air(const Section& root, const ReadContext& context) {
  Air air;
  const auto found = only_section(root, "air");
  if (!found) return air;
  const Section& section = *found;
  std::vector<Spanned<double>> turbidities;
  add_turbidities(section, turbidities, context);
  if (!turbidities.empty()) air.turbidity = turbidities;
  for (const std::string_view key : {"turbidity", "visibility", "aerosol_optical_depth"})
    refuse_twice(section, key, turbidities, std::equal_to<double>{}, context);

  std::vector<Spanned<Albedo>> albedos;
  for (const Value& value : section.values("ground_albedo"))
    albedos.push_back({std::get<Albedo>(value.data), context.sources.span(value.place)});
  refuse_twice(
      section, "ground_albedo", albedos,
      [](const Albedo& a, const Albedo& b) { return a.name == b.name; }, context);
  if (!albedos.empty()) air.ground_albedo = albedos;

  astro::RefractionConditions& refraction = air.refraction;
  refraction.enabled = section.get<bool>("refraction").value_or(refraction.enabled);
  if (const auto pressure = section.get<double>("pressure")) refraction.pressure = *pressure * hPa;
  if (const auto warmth = section.get<double>("temperature"))
    refraction.temperature = *warmth * degC;
  return air;
}

Sky build_sky(const Section& root) {
  Sky sky;
  const auto section = only_section(root, "sky");
  if (!section) return sky;
  const auto set = [&](std::string_view key, const auto& words, auto& value) {
    if (const auto word = section->get<std::string>(key)) value = *value_of(words, *word);
  };
  set("model", kSkyModelWords, sky.model);
  set("fit", kFitWords, sky.fit);
  set("solar_flux", kSolarFluxWords, sky.solar_flux);
  set("sun_algorithm", kSunAlgorithmWords, sky.sun_algorithm);
  sky.sun_disc = section->get<bool>("sun_disc").value_or(sky.sun_disc);
  return sky;
}

color::ExposureSettings build_exposure(const Section& root, const ReadContext& context) {
  color::ExposureSettings exposure;
  const auto section = only_section(root, "exposure");
  if (!section) return exposure;
  if (const auto mode = section->get<std::string>("mode"))
    exposure.mode = *value_of(kExposureModeWords, *mode);
  else if (section->has("ev") && !section->has("mode"))
    exposure.mode = color::ExposureMode::fixed;
  exposure.ev = section->get<double>("ev").value_or(exposure.ev);
  exposure.compensation = section->get<double>("compensation").value_or(exposure.compensation);
  exposure.rate_limit = section->get<double>("rate_limit").value_or(exposure.rate_limit);
  const auto only_in = [&](std::string_view key, color::ExposureMode mode, std::string_view word) {
    const bool mode_is_bad = section->has("mode") && !section->get<std::string>("mode");
    if (section->has(key) && exposure.mode != mode && !mode_is_bad)
      context.errors.add(section->field(key)->key_place,
                         fmt::format("{} has no effect here", section->path_of(key)),
                         fmt::format("it belongs to mode {}", word));
  };
  only_in("ev", color::ExposureMode::fixed, "fixed");
  only_in("rate_limit", color::ExposureMode::metered, "metered");
  return exposure;
}

ColorConfig build_color(const Section& root, const ReadContext& context) {
  ColorConfig color;
  const auto section = only_section(root, "color");
  if (!section) return color;
  color.space = section->get<std::string>("space").value_or(color.space);
  if (const auto file = section->get<std::string>("ocio")) {
    const Place place = section->place_of("ocio");
    color.ocio = Spanned<std::string>{*file, context.sources.span(place)};
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(*file, ignored))
      context.errors.add(place,
                         fmt::format("{}: there is no file {}", section->path_of("ocio"), *file),
                         "names count from the folder of the config", ErrorCode::missing_input);
  }
  return color;
}

}  // namespace skylapse::config
