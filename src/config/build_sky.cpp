#include <fmt/format.h>

#include <filesystem>

#include "config/build_job.h"
#include "config/words.h"

namespace skylapse::config {

SkyModel sky_model(const Section& root) {
  const auto section = only_section(root, "sky");
  const auto word = section ? section->get<std::string>("model") : std::nullopt;
  return word ? *value_of(kSkyModelWords, *word) : SkyModel::automatic;
}

namespace {

/// Keys of one family of models, beside a model of the other.
void refuse_keys_without_effect(const Section& section, SkyModel model,
                                const ReadContext& context) {
  const auto belong = [&](std::initializer_list<std::string_view> keys, const std::string& to) {
    for (const std::string_view key : keys)
      if (section.has(key))
        context.errors.add(section.field(key)->key_place,
                           fmt::format("{} has no effect here", section.path_of(key)),
                           fmt::format("it belongs to {}", to));
  };
  switch (model) {
    case SkyModel::automatic:
      return;
    case SkyModel::hosek_wilkie:
    case SkyModel::hosek_wilkie_gl:
      return belong({"level", "wavelengths"}, "the models bruneton and single-scattering");
    case SkyModel::bruneton:
    case SkyModel::single_scattering:
      return belong({"fit", "solar_flux"}, "the models hosek-wilkie and hosek-wilkie-gl");
  }
}

}  // namespace

Sky build_sky(const Section& root, const ReadContext& context) {
  Sky sky;
  const auto section = only_section(root, "sky");
  if (!section) return sky;
  const auto set = [&](std::string_view key, const auto& words, auto& value) {
    if (const auto word = section->get<std::string>(key)) value = *value_of(words, *word);
  };
  set("model", kSkyModelWords, sky.model);
  set("level", kLevelWords, sky.level);
  sky.wavelengths = int(section->get<long>("wavelengths").value_or(sky.wavelengths));
  set("fit", kFitWords, sky.fit);
  set("solar_flux", kSolarFluxWords, sky.solar_flux);
  set("sun_algorithm", kSunAlgorithmWords, sky.sun_algorithm);
  sky.sun_disc = section->get<bool>("sun_disc").value_or(sky.sun_disc);
  refuse_keys_without_effect(*section, sky.model, context);
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
