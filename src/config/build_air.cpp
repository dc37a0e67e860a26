#include <fmt/format.h>

#include "config/air_conversion.h"
#include "config/build_job.h"
#include "config/haze.h"
#include "config/words.h"
#include "sky/atmosphere/input_spectra.h"
#include "sky/cie/sky.h"

namespace skylapse::config {
namespace {

using sky::atmosphere::AirDescription;

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

/// Everything but haze and ground.
AirDescription description_of(const Section& air) {
  AirDescription d;
  const auto set = [](const Section& section, std::string_view key, auto& value, auto unit) {
    if (const auto number = section.get<double>(key)) value = *number * unit;
  };
  set(air, "ozone", d.ozone_du, 1.0);
  set(air, "surface_pressure", d.surface_pressure, hPa);
  set(air, "planet_radius", d.planet_radius, metre);
  set(air, "top_height", d.top_height, metre);
  if (const auto aerosol = only_section(air, "aerosol")) {
    set(*aerosol, "angstrom_exponent", d.angstrom_exponent, 1.0);
    set(*aerosol, "single_scattering_albedo", d.aerosol_single_scattering_albedo, 1.0);
    set(*aerosol, "g", d.aerosol_g, 1.0);
    set(*aerosol, "scale_height", d.aerosol_scale_height, metre);
  }
  if (const auto layer = only_section(air, "stratosphere")) {
    set(*layer, "optical_depth", d.stratospheric_optical_depth, 1.0);
    set(*layer, "bottom", d.stratospheric_bottom, metre);
    set(*layer, "top", d.stratospheric_top, metre);
  }
  return d;
}

/// Keys whose values, taken together, are no atmosphere: reported where the cure is.
void check_layers(const Section& air, const AirDescription& description,
                  const ReadContext& context) {
  const auto atmosphere = sky::atmosphere::atmosphere_of(description);
  if (atmosphere) return;
  const auto layer = only_section(air, "stratosphere");
  const bool inverted = description.stratospheric_top <= description.stratospheric_bottom;
  const Place place = layer && inverted       ? layer->place_of("top")
                      : air.has("top_height") ? air.place_of("top_height")
                      : layer                 ? layer->place_of("top")
                                              : air.place;
  context.errors.add(place, fmt::format("air: {}", atmosphere.error().message),
                     atmosphere.error().hint);
}

struct AtmosphereKey {
  std::string_view key;
  bool in_use;
};

/// Keys of `air` whose values the fitted models know nothing of.
std::vector<AtmosphereKey> atmosphere_keys(const Section& air, const AirDescription& d) {
  const AirDescription plain;
  return {
      {"preset", air.has("preset")},
      {"aerosol",
       d.angstrom_exponent != plain.angstrom_exponent ||
           d.aerosol_single_scattering_albedo != plain.aerosol_single_scattering_albedo ||
           d.aerosol_g != plain.aerosol_g || d.aerosol_scale_height != plain.aerosol_scale_height},
      {"stratosphere", d.stratospheric_optical_depth > 0},
      {"ozone", d.ozone_du != plain.ozone_du},
      {"surface_pressure", d.surface_pressure != plain.surface_pressure},
      {"planet_radius", d.planet_radius != plain.planet_radius},
      {"top_height", d.top_height != plain.top_height},
      {"keyframes", air.has("keyframes")},
  };
}

/// Sets `needs_atmosphere`, or reports the keys that the demanded model makes nothing of.
void note_atmosphere_keys(const Section& section, SkyModel model, Air& air,
                          const ReadContext& context) {
  for (const AtmosphereKey& key : atmosphere_keys(section, air.description)) {
    if (!key.in_use) continue;
    // What came with a preset is the preset's doing.
    const Place place = section.field(key.key)->key_place;
    if (is_fitted(model) && (key.key == "preset" || !section.has("preset")))
      context.errors.add(
          place,
          fmt::format("{} means nothing to {}", section.path_of(key.key), fitted_name(model)),
          "use sky.model bruneton, single-scattering or auto");
    if (!air.needs_atmosphere)
      air.needs_atmosphere =
          Spanned<std::string>{section.path_of(key.key), context.sources.span(place)};
  }
}

void read_haze(const Section& section, const HazeReader& haze, Air& air,
               const ReadContext& context) {
  std::vector<Spanned<double>> turbidities;
  for (const std::string_view key : kHazeKeys)
    for (const Value& value : section.values(key)) {
      if (haze.is_covered()) {
        context.errors.add(section.field(key)->key_place,
                           fmt::format("{} means nothing to a covered sky", section.path_of(key)),
                           "sky.cie_type 7 to 15 are skies with the sun in them");
        break;
      }
      const auto turbidity = haze.turbidity(section, key, value);
      if (!turbidity) continue;
      turbidities.push_back({*turbidity, context.sources.span(value.place)});
      if (!within_hosek_wilkie(*turbidity) && !air.needs_atmosphere)
        air.needs_atmosphere = Spanned<std::string>{section.path_of(key), turbidities.back().span};
    }
  if (!turbidities.empty()) air.turbidity = turbidities;
  for (const std::string_view key : kHazeKeys)
    refuse_twice(section, key, turbidities, std::equal_to<double>{}, context);
}

void read_grounds(const Section& section, Air& air, const ReadContext& context) {
  std::vector<Spanned<Albedo>> albedos;
  for (const Value& value : section.values("ground_albedo"))
    albedos.push_back({std::get<Albedo>(value.data), context.sources.span(value.place)});
  refuse_twice(
      section, "ground_albedo", albedos,
      [](const Albedo& a, const Albedo& b) { return a.name == b.name; }, context);
  if (!albedos.empty()) air.ground_albedo = albedos;
}

void read_refraction(const Section& section, Air& air) {
  astro::RefractionConditions& refraction = air.refraction;
  refraction.enabled = section.get<bool>("refraction").value_or(refraction.enabled);
  if (const auto pressure = section.get<double>("pressure")) refraction.pressure = *pressure * hPa;
  air.observer_pressure_given = section.has("pressure");
  if (const auto warmth = section.get<double>("temperature"))
    refraction.temperature = *warmth * degC;
}

}  // namespace

Air build_air(const Section& root, const std::vector<Site>& sites, const ReadContext& context) {
  Air air;
  const auto section = only_section(root, "air");
  if (sky_model(root) == SkyModel::cie && !sky::cie::is_covered(cie_type(root)))
    air.turbidity = {{sky::cie::typical_turbidity(cie_type(root)), {}}};
  if (section) {
    const SkyModel model = sky_model(root);
    air.description = description_of(*section);
    check_layers(*section, air.description, context);
    note_atmosphere_keys(*section, model, air, context);
    read_haze(*section, {air.description, model, cie_type(root), context}, air, context);
    read_grounds(*section, air, context);
    read_refraction(*section, air);
  }
  air.description.aerosol_optical_depth =
      std::max(0.0, aerosol_depth_from_turbidity(air.turbidity[0].value));
  air.description.ground_albedo = ground_spectrum(air.ground_albedo[0].value);
  if (section) air.keyframes = build_keyframes(root, *section, air, sites, context);
  return air;
}

sky::atmosphere::Spectrum ground_spectrum(const Albedo& albedo) {
  if (albedo.spectral)
    if (auto spectrum = sky::atmosphere::ground_albedo_spectrum(albedo.name)) return *spectrum;
  return sky::atmosphere::constant_spectrum(albedo.value);
}

}  // namespace skylapse::config
