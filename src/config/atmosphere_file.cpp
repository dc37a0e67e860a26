#include "config/atmosphere_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/build_job.h"
#include "config/text_file.h"
#include "config/yaml_reader.h"

namespace skylapse::config {
namespace {

using sky::atmosphere::Atmosphere;
using sky::atmosphere::DensityProfile;
using sky::atmosphere::Spectrum;

Spectrum spectrum_of(const Section& parent, std::string_view key, double highest,
                     const ReadContext& context) {
  Spectrum spectrum;
  const auto section = only_section(parent, key);
  if (!section) return spectrum;
  for (const std::string_view values : {"constant", "values"})
    for (const Value& value : section->values(values)) {
      spectrum.value.push_back(std::get<double>(value.data));
      if (spectrum.value.back() > highest)
        context.errors.add(value.place,
                           fmt::format("{} is above {:g}", section->path_of(values), highest),
                           fmt::format("allowed: 0 to {:g}", highest));
    }
  if (section->has("constant")) {
    if (section->has("wavelengths"))
      context.errors.add(
          section->field("wavelengths")->key_place,
          fmt::format("{} has no meaning beside a constant", section->path_of("wavelengths")),
          "write `values` for them");
    spectrum.wavelength_nm = {550};
    return spectrum;
  }
  for (const Value& value : section->values("wavelengths")) {
    spectrum.wavelength_nm.push_back(std::get<double>(value.data));
    const size_t count = spectrum.wavelength_nm.size();
    if (count > 1 && spectrum.wavelength_nm[count - 2] >= spectrum.wavelength_nm[count - 1])
      context.errors.add(value.place,
                         fmt::format("{} does not rise here", section->path_of("wavelengths")),
                         "write wavelengths in rising order, each once");
  }
  const bool all_read = section->has("values") && !section->values("values").empty();
  if (all_read && spectrum.wavelength_nm.size() != spectrum.value.size())
    context.errors.add(section->place_of(section->has("wavelengths") ? "wavelengths" : "values"),
                       fmt::format("{} has {} values at {} wavelengths", section->path,
                                   spectrum.value.size(), spectrum.wavelength_nm.size()),
                       "write as many wavelengths as values");
  return spectrum;
}

DensityProfile layer_of(const Section& layer, Length atmosphere_top, const ReadContext& context) {
  const Length bottom = layer.get<double>("bottom").value_or(0) * metre;
  const Length top = layer.get<double>("top").value_or(atmosphere_top.in(metre)) * metre;
  const Place place = layer.place_of(layer.has("top") ? "top" : "bottom");
  if (!(bottom < top)) {
    context.errors.add(place, fmt::format("{} ends at or below its bottom", layer.path),
                       "a layer reaches from its bottom up to its top");
    return {};
  }
  const std::string_view kind = layer.spec->keys[0].name;
  if (kind == "peak") {
    const Length peak = layer.get<double>("peak").value_or(bottom.in(metre)) * metre;
    if (peak < bottom || peak > top)
      context.errors.add(layer.place_of("peak"),
                         fmt::format("{} is outside the layer", layer.path_of("peak")),
                         fmt::format("allowed: {:g} km to {:g} km", bottom.in(km), top.in(km)));
    DensityProfile tent = sky::atmosphere::tent_profile(bottom, peak, top);
    const double density = layer.get<double>("density").value_or(1);
    for (auto& term : tent.terms) term.slope_per_km *= density, term.constant *= density;
    return tent;
  }
  sky::atmosphere::DensityTerm term{.bottom_km = bottom.in(km), .top_km = top.in(km)};
  if (kind == "scale_height") {
    const double scale_height = layer.get<double>(kind).value_or(1e3);
    term.amplitude = layer.get<double>("density").value_or(1);
    term.inverse_scale_height_per_km = 1 / (scale_height * metre).in(km);
  } else {
    term.constant = layer.get<double>("intercept").value_or(0);
    term.slope_per_km = layer.get<double>("slope_per_km").value_or(0);
  }
  return {{term}};
}

DensityProfile density_of(const Section& part, Length top, const ReadContext& context) {
  DensityProfile profile;
  for (const auto& layer : part.sections("density"))
    for (const auto& term : layer_of(*layer, top, context).terms) profile.terms.push_back(term);
  if (profile.terms.size() > size_t{sky::atmosphere::kMaxDensityTerms})
    context.errors.add(
        part.place_of("density"),
        fmt::format("{} has {} pieces", part.path_of("density"), profile.terms.size()),
        fmt::format("allowed: at most {} (a tent is two)", sky::atmosphere::kMaxDensityTerms));
  return profile;
}

/// A profile of the default air reaches the file's top, not its own.
Atmosphere default_atmosphere(Length top, const Section& root, const ReadContext& context) {
  sky::atmosphere::AirDescription air;
  air.top_height = top;
  if (root.has("ozone")) air.ozone_du = 0;
  const auto atmosphere = atmosphere_of(air);
  if (atmosphere) return *atmosphere;
  context.errors.add(root.place_of("top_height"), atmosphere.error().message,
                     atmosphere.error().hint);
  return {};
}

constexpr double kAnyValue = 1e6;  // as in the table of keys

Atmosphere build_atmosphere(const Section& root, const ReadContext& context) {
  const Length top = root.get<double>("top_height").value_or(100e3) * metre;
  Atmosphere air = default_atmosphere(top, root, context);
  if (const auto radius = root.get<double>("planet_radius")) air.bottom_radius = *radius * metre;
  if (const auto radius = root.get<double>("sun_angular_radius"))
    air.sun_angular_radius = *radius * rad;
  if (root.has("solar_irradiance"))
    air.solar_irradiance = spectrum_of(root, "solar_irradiance", kAnyValue, context);
  if (root.has("ground_albedo")) air.ground_albedo = spectrum_of(root, "ground_albedo", 1, context);
  if (const auto part = only_section(root, "rayleigh")) {
    air.rayleigh_scattering = spectrum_of(*part, "scattering", kAnyValue, context);
    air.rayleigh_depolarization = part->get<double>("depolarization").value_or(0);
    air.rayleigh = density_of(*part, top, context);
  }
  if (const auto part = only_section(root, "aerosol")) {
    air.aerosol_extinction = spectrum_of(*part, "extinction", kAnyValue, context);
    air.aerosol_single_scattering_albedo =
        spectrum_of(*part, "single_scattering_albedo", 1, context);
    air.aerosol_g = part->get<double>("g").value_or(air.aerosol_g);
    air.aerosol = density_of(*part, top, context);
  }
  if (const auto part = only_section(root, "ozone")) {
    air.ozone_absorption = spectrum_of(*part, "absorption", kAnyValue, context);
    air.ozone = density_of(*part, top, context);
  }
  return air;
}

}  // namespace

Result<Atmosphere, Diagnostics> parse_atmosphere(const std::string& text, const std::string& name) {
  SourceSet sources;
  ErrorList errors;
  const int file = sources.add(name, normalised_text(text));
  auto root = read_yaml(sources, file, errors);
  if (root && root->kind != Node::Kind::map && root->kind != Node::Kind::null)
    errors.add(root->place, "an atmosphere is a section with keys",
               "it begins with keys such as \"planet_radius:\" and \"rayleigh:\"");
  if (!root || !errors.empty()) return errors.diagnostics(sources);
  ReadContext context{sources, errors, {}};
  const Section section = read_section(*root, atmosphere_spec(), "", {file, 1, 1, 0}, context);
  const Atmosphere air = build_atmosphere(section, context);
  if (!errors.empty()) return errors.diagnostics(sources);
  // What single values do not show: the same check as of every medium.
  if (const Status status = check(medium_sampled(air, {550.0 * nm})); !status) {
    errors.add({file, 1, 1, 0}, status.error().message, status.error().hint);
    return errors.diagnostics(sources);
  }
  return air;
}

Result<Atmosphere, Diagnostics> load_atmosphere(const std::string& path) {
  const auto text = read_text_file(path, "atmosphere");
  if (!text) return text.error();
  return parse_atmosphere(*text, path);
}

}  // namespace skylapse::config
