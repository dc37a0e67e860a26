#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <type_traits>

#include "config/build_job.h"
#include "config/words.h"

namespace skylapse::config {

SkyModel sky_model(const Section& root) {
  const auto section = only_section(root, "sky");
  const auto word = section ? section->get<std::string>("model") : std::nullopt;
  return word ? *value_of(kSkyModelWords, *word) : SkyModel::automatic;
}

int cie_type(const Section& root) {
  const auto section = only_section(root, "sky");
  const auto type = section ? section->get<long>("cie_type") : std::nullopt;
  return type ? int(*type) : Sky{}.cie_type;
}

namespace {

/// The models that know a key.
struct KeyOwners {
  std::string_view key;
  std::vector<SkyModel> models;
  std::string_view named;
};

const std::vector<KeyOwners>& key_owners() {
  using enum SkyModel;
  static const std::vector<KeyOwners> owners{
      {"level", {bruneton}, "the model bruneton"},
      {"wavelengths",
       {bruneton, single_scattering, reference},
       "the models bruneton, single-scattering and reference"},
      {"orders", {bruneton, reference}, "the models bruneton and reference"},
      {"steps", {bruneton, single_scattering}, "the models bruneton and single-scattering"},
      {"slice", {bruneton, single_scattering}, "the models bruneton and single-scattering"},
      {"precision", {bruneton, single_scattering}, "the models bruneton and single-scattering"},
      {"samples", {reference}, "the model reference"},
      {"relative_error", {reference}, "the model reference"},
      {"seed", {reference}, "the model reference"},
      {"cie_type", {cie}, "the model cie"},
      {"fit", {hosek_wilkie, hosek_wilkie_gl}, "the models hosek-wilkie and hosek-wilkie-gl"},
      {"solar_flux",
       {hosek_wilkie, hosek_wilkie_gl},
       "the models hosek-wilkie and hosek-wilkie-gl"},
      {"accuracy", {}, "the model auto"},
      {"time_budget", {}, "the model auto"},
  };
  return owners;
}

/// Keys that another model has.
void refuse_keys_without_effect(const Section& section, SkyModel model,
                                const ReadContext& context) {
  const auto obeyed = [&](const KeyOwners& owner) {
    if (model != SkyModel::automatic)
      return std::ranges::find(owner.models, model) != owner.models.end();
    // `auto` never takes these two by itself.
    return std::ranges::any_of(
               owner.models,
               [](SkyModel m) { return m != SkyModel::reference && m != SkyModel::cie; }) ||
           owner.models.empty();
  };
  for (const KeyOwners& owner : key_owners()) {
    if (!section.has(owner.key) || obeyed(owner)) continue;
    context.errors.add(section.field(owner.key)->key_place,
                       fmt::format("{} has no effect here", section.path_of(owner.key)),
                       fmt::format("it belongs to {}", owner.named));
  }
}

/// A promise leaves the means to the planner.
void refuse_means_beside_a_promise(const Section& section, const ReadContext& context) {
  for (const std::string_view promise : {"accuracy", "time_budget"})
    for (const std::string_view means : {"level", "wavelengths", "orders", "steps", "slice",
                                         "precision", "samples", "relative_error", "fit"})
      if (section.has(promise) && section.has(means))
        context.errors.add(
            section.field(means)->key_place,
            fmt::format("{} beside {}", section.path_of(means), section.path_of(promise)),
            "write the one or the other: the promise chooses how it is kept");
}

EffectChoice effects_of(const Section& section, const ReadContext& context) {
  EffectChoice choice;
  const auto& values = section.values("effects");
  for (const Value& value : values) {
    const auto& word = std::get<std::string>(value.data);
    if (word == "auto" || word == "all") {
      if (values.size() > 1)
        context.errors.add(value.place, fmt::format("'{}' among other effects", word),
                           "write it alone, or a list of effects without it");
      choice.rule = word == "all" ? EffectChoice::Rule::all : EffectChoice::Rule::automatic;
      continue;
    }
    choice.rule = EffectChoice::Rule::listed;
    choice.listed.push_back(*value_of(sky::kEffectNames, word));
  }
  return choice;
}

/// What is left out by a list is in no calibrated bound.
void refuse_list_beside_a_promise(const Section& section, const Sky& sky,
                                  const ReadContext& context) {
  if (sky.effects.rule != EffectChoice::Rule::listed) return;
  for (const std::string_view promise : {"accuracy", "time_budget"})
    if (section.has(promise))
      context.errors.add(section.field("effects")->key_place,
                         fmt::format("a list of {} beside {}", section.path_of("effects"),
                                     section.path_of(promise)),
                         "a promise is about the whole sky: write effects: auto or all");
}

/// Below the least numbers the two halves of the table have no shape; above the greatest it is
/// larger than any picture.
void read_slice(const Section& section, const ReadContext& context, Sky& sky) {
  const auto size = section.get<PixelSize>("slice");
  if (!size) return;
  if (size->height == 0) {
    context.errors.add(section.place_of("slice"),
                       fmt::format("{} names one number", section.path_of("slice")),
                       "write azimuths x zeniths, as in 64x128");
    return;
  }
  if (size->width < 4 || size->width > 2048 || size->height < 8 || size->height > 4096 ||
      size->height % 2 != 0) {
    context.errors.add(section.place_of("slice"),
                       fmt::format("{} = {}x{} is no table of directions", section.path_of("slice"),
                                   size->width, size->height),
                       "allowed: 4 to 2048 azimuths, an even number from 8 to 4096 of zeniths");
    return;
  }
  sky.slice_azimuths = size->width, sky.slice_zeniths = size->height;
}

}  // namespace

Sky build_sky(const Section& root, const ReadContext& context) {
  Sky sky;
  const auto section = only_section(root, "sky");
  if (!section) return sky;
  const auto set = [&](std::string_view key, const auto& words, auto& value) {
    if (const auto word = section->get<std::string>(key)) value = *value_of(words, *word);
  };
  const auto set_integer = [&](std::string_view key, auto& value) {
    if (const auto number = section->get<long>(key))
      value = std::remove_reference_t<decltype(value)>(*number);
  };
  const auto span_of = [&](std::string_view key) {
    return context.sources.span(section->place_of(key));
  };
  set("model", kSkyModelWords, sky.model);
  if (const auto share = section->get<double>("accuracy"))
    sky.accuracy = Spanned<double>{*share, span_of("accuracy")};
  if (const auto seconds = section->get<double>("time_budget"))
    sky.time_budget = Spanned<Duration>{*seconds * second, span_of("time_budget")};
  sky.effects = effects_of(*section, context);
  set("level", kLevelWords, sky.level);
  set_integer("wavelengths", sky.wavelengths);
  sky.wavelengths_given = section->has("wavelengths");
  set_integer("orders", sky.orders);
  set_integer("steps", sky.steps);
  read_slice(*section, context, sky);
  set("precision", kPrecisionWords, sky.precision);
  set_integer("samples", sky.paths.samples);
  sky.paths.relative_error = section->get<double>("relative_error");
  set_integer("seed", sky.paths.seed);
  set_integer("cie_type", sky.cie_type);
  set("fit", kFitWords, sky.fit);
  set("solar_flux", kSolarFluxWords, sky.solar_flux);
  set("sun_algorithm", kSunAlgorithmWords, sky.sun_algorithm);
  sky.sun_disc = section->get<bool>("sun_disc").value_or(sky.sun_disc);
  refuse_keys_without_effect(*section, sky.model, context);
  refuse_means_beside_a_promise(*section, context);
  refuse_list_beside_a_promise(*section, sky, context);
  for (const std::string_view key : {"orders", "steps", "slice", "precision"})
    if (section->has(key) && !sky.needs_atmosphere)
      sky.needs_atmosphere = Spanned<std::string>{
          section->path_of(key), context.sources.span(section->field(key)->key_place)};
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
