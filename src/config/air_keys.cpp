// Keys of air and sky. The rows are explained in key_spec.h.
#include "config/air_presets.h"
#include "config/key_sections.h"
#include "config/words.h"

namespace skylapse::config {
namespace {

using K = ValueKind;
using D = Dimension;

const SectionSpec& aerosol_spec() {
  static const SectionSpec spec{
      .name = "aerosol",
      .doc = "What the haze is made of, for the models that compute the atmosphere.",
      .keys = {
          {.name = "angstrom_exponent",
           .kind = K::number,
           .min = "-1",
           .max = "4",
           .default_text = "1.3",
           .example = "0.2",
           .doc = "Optical depth falls with this power of the wavelength: 0 is grey (dust, salt, "
                  "fog), 1.3 ordinary haze, 2 fine smoke."},
          {.name = "single_scattering_albedo",
           .kind = K::number,
           .min = "0",
           .max = "1",
           .default_text = "0.92",
           .example = "0.85",
           .doc = "Share of the light taken out of a ray that is scattered, not absorbed."},
          {.name = "g",
           .kind = K::number,
           .min = "-0.99",
           .max = "0.99",
           .default_text = "0.7",
           .example = "0.76",
           .doc = "Shape of the Cornette-Shanks phase function; the mean cosine is "
                  "3g(4 + g²)/(5(2 + g²)), 0.757 for 0.7."},
          {.name = "scale_height",
           .kind = K::quantity,
           .dimension = D::length,
           .min = "10 m",
           .max = "20 km",
           .default_text = "1.2 km",
           .example = "800 m",
           .doc = "Height over which the haze thins to 37 %."},
      }};
  return spec;
}

const SectionSpec& stratosphere_spec() {
  static const SectionSpec spec{
      .name = "stratosphere",
      .doc = "A layer of aerosol high up, as after a volcano's eruption: densest in its middle.",
      .keys = {
          {.name = "optical_depth",
           .kind = K::number,
           .min = "0",
           .max = "10",
           .default_text = "0",
           .example = "0.15",
           .doc = "Its optical depth at 550 nm, vertical, added to that of the haze."},
          {.name = "bottom",
           .kind = K::quantity,
           .dimension = D::length,
           .min = "0 km",
           .max = "200 km",
           .default_text = "15 km",
           .example = "16 km",
           .doc = "Where the layer begins."},
          {.name = "top",
           .kind = K::quantity,
           .dimension = D::length,
           .min = "1 km",
           .max = "200 km",
           .default_text = "25 km",
           .example = "26 km",
           .doc = "Where it ends."},
      }};
  return spec;
}

// One place for the ranges that the air and its keyframes share.
const KeySpec kTurbidityKey{
    .name = "turbidity",
    .kind = K::number,
    .min = "1",
    .max = "10",
    .default_text = "2.5",
    .example = "3",
    .doc =
        "Preetham's turbidity: 2 very clear, 3 clear, 6 hazy, 10 dense haze. "
        "Thicker air: visibility or aerosol_optical_depth."};
const KeySpec kVisibilityKey{
    .name = "visibility",
    .kind = K::quantity,
    .dimension = D::length,
    .min = "200 m",
    .max = "1000 km",
    .example = "40 km",
    .doc = "Meteorological range at 550 nm (2 % contrast), converted to the haze that leaves it."};
const KeySpec kAerosolDepthKey{.name = "aerosol_optical_depth",
                               .kind = K::number,
                               .min = "0",
                               .max = "30",
                               .example = "0.1",
                               .doc = "Optical depth of the haze at 550 nm, vertical."};
const KeySpec kOzoneKey{.name = "ozone",
                        .kind = K::quantity,
                        .dimension = D::ozone,
                        .min = "0 DU",
                        .max = "1000 DU",
                        .default_text = "300 DU",
                        .example = "350 DU",
                        .doc = "Ozone above the ground; it turns twilight blue."};

KeySpec listed(KeySpec key) {
  key.list = true;
  return key;
}

KeySpec without_default(KeySpec key) {
  key.default_text = {};
  return key;
}

const SectionSpec& keyframe_spec() {
  static const SectionSpec spec{
      .name = "air keyframe",
      .doc =
          "The air at a time. Between two keyframes aerosol depth and ozone go linearly from one "
          "to the other, before the first and after the last they stay. What a keyframe leaves "
          "out is as in `air`.",
      .keys = {{.name = "time",
                .kind = K::time,
                .required = true,
                .example = "06:00",
                .doc = "When; without a day, on every day of the job."},
               without_default(kTurbidityKey),
               kVisibilityKey,
               kAerosolDepthKey,
               without_default(kOzoneKey)},
      .alternatives = {{{"turbidity", "visibility", "aerosol_optical_depth"}}}};
  return spec;
}

}  // namespace

const SectionSpec& air_spec() {
  static const SectionSpec spec{
      .name = "air",
      .doc = "The air and the ground. Lists multiply the job.",
      .keys =
          {
              {.name = "preset",
               .kind = K::word,
               .words = preset_names(),
               .example = "rural",
               .doc = "Air by name, from configs/presets; keys written beside it win."},
              listed(kTurbidityKey),
              listed(kVisibilityKey),
              listed(kAerosolDepthKey),
              {.name = "aerosol",
               .kind = K::section,
               .sections = {&aerosol_spec()},
               .example = "{g: 0.76}",
               .doc = "What the haze is made of."},
              {.name = "stratosphere",
               .kind = K::section,
               .sections = {&stratosphere_spec()},
               .example = "{optical_depth: 0.15}",
               .doc = "A layer of aerosol high up."},
              kOzoneKey,
              {.name = "surface_pressure",
               .kind = K::quantity,
               .dimension = D::pressure,
               .min = "0 hPa",
               .max = "10000 hPa",
               .default_text = "1013.25 hPa",
               .example = "990 hPa",
               .doc = "Pressure at height 0: how much air there is to scatter light."},
              {.name = "planet_radius",
               .kind = K::quantity,
               .dimension = D::length,
               .min = "100 km",
               .max = "100000 km",
               .default_text = "6371 km",
               .example = "6360 km",
               .doc = "Radius of the ground, height 0."},
              {.name = "top_height",
               .kind = K::quantity,
               .dimension = D::length,
               .min = "1 km",
               .max = "200 km",
               .default_text = "100 km",
               .example = "60 km",
               .doc = "Height of the top of the atmosphere; there is no air above."},
              {.name = "keyframes",
               .kind = K::section_list,
               .sections = {&keyframe_spec()},
               .example = "[{time: 06:00, visibility: 10 km}, {time: 12:00, visibility: 40 km}]",
               .doc = "Air that changes during the day."},
              {.name = "ground_albedo",
               .kind = K::albedo,
               .min = "0",
               .max = "1",
               .list = true,
               .default_text = "0.2",
               .example = "grass",
               .doc = "Reflectance of the ground: a number, or the name of a measured spectrum."},
              {.name = "refraction",
               .kind = K::on_off,
               .default_text = "on",
               .example = "off",
               .doc = "Whether the air lifts sun and moon."},
              {.name = "pressure",
               .kind = K::quantity,
               .dimension = D::pressure,
               .min = "0 hPa",
               .max = "1100 hPa",
               .default_text = "1010 hPa",
               .example = "1013.25 hPa",
               .doc = "Air pressure at the observer, for refraction."},
              {.name = "temperature",
               .kind = K::quantity,
               .dimension = D::temperature,
               .min = "-100 degC",
               .max = "60 degC",
               .default_text = "10 degC",
               .example = "15 degC",
               .doc = "Air temperature at the observer, for refraction."},
          },
      .alternatives = {{{"turbidity", "visibility", "aerosol_optical_depth"}}}};
  return spec;
}

}  // namespace skylapse::config
