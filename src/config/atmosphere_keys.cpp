// Keys of an atmosphere file. The rows are explained in key_spec.h.
#include "config/atmosphere_file.h"

namespace skylapse::config {
namespace {

using K = ValueKind;
using D = Dimension;

const SectionSpec& spectrum_spec() {
  static const SectionSpec spec{
      .name = "spectrum",
      .doc =
          "A function of wavelength: one value for all, or values at wavelengths, linear between "
          "them and constant beyond the ends.",
      .keys = {{.name = "constant",
                .kind = K::number,
                .min = "0",
                .max = "1000000",
                .example = "0.1",
                .doc = "The same at all wavelengths."},
               {.name = "values",
                .kind = K::number,
                .min = "0",
                .max = "1000000",
                .list = true,
                .example = "[1.474, 1.8504]",
                .doc = "One value for each of `wavelengths`."},
               {.name = "wavelengths",
                .kind = K::quantity,
                .dimension = D::wavelength,
                .min = "1 nm",
                .max = "100000 nm",
                .list = true,
                .example = "[550 nm, 680 nm]",
                .doc = "Where the values belong, rising."}},
      .alternatives = {{{"constant", "values"}, true}}};
  return spec;
}

/// Heights that layers begin and end at.
KeySpec height(std::string_view name, std::string_view min, std::string_view default_text,
               std::string_view doc) {
  return {.name = name,
          .kind = K::quantity,
          .dimension = D::length,
          .min = min,
          .max = "1000 km",
          .default_text = default_text,
          .example = "12 km",
          .doc = doc};
}

const SectionSpec& exponential_layer_spec() {
  static const SectionSpec spec{
      .name = "exponential layer",
      .doc =
          "Density that falls by a constant factor over equal heights. Layers add up, at most "
          "eight pieces in all (a tent is two).",
      .keys = {{.name = "scale_height",
                .kind = K::quantity,
                .dimension = D::length,
                .min = "1 m",
                .max = "10000 km",
                .required = true,
                .example = "8 km",
                .doc = "Height over which it falls to 37 %."},
               {.name = "density",
                .kind = K::number,
                .min = "0",
                .max = "1000000",
                .default_text = "1",
                .example = "0.5",
                .doc = "Density that it would have at height 0."},
               height("bottom", "0 km", "0 km", "Where the layer begins."),
               height("top", "1 m", {}, "Where it ends. Default: the top of the atmosphere.")}};
  return spec;
}

const SectionSpec& tent_layer_spec() {
  static const SectionSpec spec{
      .name = "tent layer",
      .doc = "Density that rises from 0 in a straight line to a peak and falls back to 0.",
      .keys = {{.name = "peak",
                .kind = K::quantity,
                .dimension = D::length,
                .min = "0 km",
                .max = "1000 km",
                .required = true,
                .example = "25 km",
                .doc = "Height of the peak."},
               {.name = "bottom",
                .kind = K::quantity,
                .dimension = D::length,
                .min = "0 km",
                .max = "1000 km",
                .required = true,
                .example = "10 km",
                .doc = "Where the layer begins."},
               {.name = "top",
                .kind = K::quantity,
                .dimension = D::length,
                .min = "0 km",
                .max = "1000 km",
                .required = true,
                .example = "40 km",
                .doc = "Where it ends."},
               {.name = "density",
                .kind = K::number,
                .min = "0",
                .max = "1000000",
                .default_text = "1",
                .example = "0.5",
                .doc = "Density at the peak."}}};
  return spec;
}

const SectionSpec& straight_layer_spec() {
  static const SectionSpec spec{
      .name = "straight layer",
      .doc = "Density along a straight line, 0 where the line is below 0.",
      .keys = {{.name = "intercept",
                .kind = K::number,
                .min = "-1000000",
                .max = "1000000",
                .required = true,
                .example = "1",
                .doc = "Density that the line has at height 0."},
               {.name = "slope_per_km",
                .kind = K::number,
                .min = "-1000000",
                .max = "1000000",
                .default_text = "0",
                .example = "-0.1",
                .doc = "How much it changes over a kilometre."},
               height("bottom", "0 km", "0 km", "Where the layer begins."),
               height("top", "1 m", {}, "Where it ends. Default: the top of the atmosphere.")}};
  return spec;
}

KeySpec spectrum(std::string_view name, std::string_view doc) {
  return {.name = name,
          .kind = K::section,
          .required = true,
          .sections = {&spectrum_spec()},
          .example = "{wavelengths: [440 nm, 680 nm], values: [0.0331, 0.0058]}",
          .doc = doc};
}

KeySpec density() {
  return {.name = "density",
          .kind = K::section_list,
          .required = true,
          .sections = {&exponential_layer_spec(), &tent_layer_spec(), &straight_layer_spec()},
          .example = "[{scale_height: 8 km}]",
          .doc = "Layers of relative density: 1 where the coefficients are quoted."};
}

const SectionSpec& rayleigh_spec() {
  static const SectionSpec spec{
      .name = "rayleigh",
      .doc = "Molecules of the air.",
      .keys = {spectrum("scattering", "Scattering coefficient per km, where the density is 1."),
               {.name = "depolarization",
                .kind = K::number,
                .min = "0",
                .max = "1",
                .default_text = "0",
                .example = "0.0283",
                .doc = "Depolarization of the scattered light; 0 is the plain 3/(16π)(1 + cos²)."},
               density()}};
  return spec;
}

const SectionSpec& haze_spec() {
  static const SectionSpec spec{
      .name = "haze",
      .doc = "Aerosol.",
      .keys = {spectrum("extinction",
                        "Extinction (scattering and absorption) per km, where the density is 1."),
               spectrum("single_scattering_albedo", "Share of it that is scattered, 0 to 1."),
               {.name = "g",
                .kind = K::number,
                .min = "-0.99",
                .max = "0.99",
                .required = true,
                .example = "0.8",
                .doc = "Shape of the Cornette-Shanks phase function."},
               density()}};
  return spec;
}

const SectionSpec& ozone_spec() {
  static const SectionSpec spec{
      .name = "absorber",
      .doc = "Ozone, or whatever absorbs without scattering.",
      .keys = {spectrum("absorption", "Absorption coefficient per km, where the density is 1."),
               density()}};
  return spec;
}

KeySpec part(std::string_view name, const SectionSpec& spec, std::string_view doc) {
  return {.name = name, .kind = K::section, .sections = {&spec}, .doc = doc};
}

}  // namespace

const SectionSpec& atmosphere_spec() {
  static const SectionSpec spec{
      .name = "",
      .doc = "An atmosphere. What is not written is that of the default air of a job.",
      .keys = {
          {.name = "title",
           .kind = K::text,
           .example = "Mars at noon",
           .doc = "A line about the atmosphere, for its readers."},
          {.name = "planet_radius",
           .kind = K::quantity,
           .dimension = D::length,
           .min = "1 km",
           .max = "1000000 km",
           .default_text = "6371 km",
           .example = "6360 km",
           .doc = "Radius of the ground, height 0."},
          {.name = "top_height",
           .kind = K::quantity,
           .dimension = D::length,
           .min = "1 km",
           .max = "1000 km",
           .default_text = "100 km",
           .example = "60 km",
           .doc = "Height of the top; there is no air above."},
          {.name = "sun_angular_radius",
           .kind = K::quantity,
           .dimension = D::angle,
           .min = "0 deg",
           .max = "10 deg",
           .default_text = "959.63 arcsec",
           .example = "0.004675 rad",
           .doc = "Half the width of the sun's disc."},
          part("solar_irradiance", spectrum_spec(),
               "Sunlight above the atmosphere at 1 au, W m⁻² nm⁻¹."),
          part("rayleigh", rayleigh_spec(), "Molecules of the air."),
          part("aerosol", haze_spec(), "Haze."),
          part("ozone", ozone_spec(), "Absorber."),
          part("ground_albedo", spectrum_spec(), "Lambert reflectance of the ground, 0 to 1."),
      }};
  return spec;
}

}  // namespace skylapse::config
