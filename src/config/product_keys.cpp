// Keys of what renderers want of a sky beside its picture. The rows are explained in key_spec.h.
#include "config/key_sections.h"
#include "config/words.h"

namespace skylapse::config {
namespace {

using K = ValueKind;

KeySpec path_key(std::string_view name, std::string_view example, std::string_view doc) {
  return {.name = name, .kind = K::output_path, .required = true, .example = example, .doc = doc};
}

KeySpec orientation_key(std::string_view default_text, std::string_view doc) {
  return {.name = "orientation",
          .kind = K::word,
          .words = words_of(kOrientationWords),
          .default_text = default_text,
          .example = "three",
          .doc = doc};
}

KeySpec numbers_key(std::string_view doc) {
  return {
      .name = "type", .kind = K::word, .words = {"half", "float"}, .example = "float", .doc = doc};
}

KeySpec disc_key(std::string_view doc) {
  return {
      .name = "sun_disc", .kind = K::on_off, .default_text = "on", .example = "off", .doc = doc};
}

KeySpec size_key(std::string_view default_text, std::string_view doc) {
  KeySpec key = *find_key_spec(camera_spec(), "size");
  key.default_text = default_text;
  key.example = default_text;
  key.doc = doc;
  return key;
}

}  // namespace

const SectionSpec& specular_spec() {
  static const SectionSpec spec{
      .name = "specular output",
      .doc =
          "A cube of the sky for glossy reflection: each level is filtered by the GGX lobe of a "
          "greater roughness.",
      .keys = {
          path_key("specular", "{site}_{date}_{time}_specular.ktx2",
                   "File name, relative to the output folder, ending in ktx2 (all levels in one "
                   "file), or in exr or hdr with the token {level}, and {face} for six files a "
                   "level."),
          numbers_key("Numbers in the file. Default half (ktx2, exr), float (hdr)."),
          size_key("256", "Side of a face of the first level, in pixels; a power of 2."),
          {.name = "levels",
           .kind = K::integer,
           .min = "0",
           .max = "14",
           .default_text = "0",
           .example = "6",
           .doc = "Levels of roughness 0 to 1, each half as large as the one before; 0: down to "
                  "faces of 4 pixels."},
          orientation_key("openexr", "How the faces lie (docs/hdri.md)."),
          disc_key("With the light of the sun's disc."),
      }};
  return spec;
}

const SectionSpec& irradiance_spec() {
  static const SectionSpec spec{
      .name = "irradiance output",
      .doc = "A map of the irradiance of a surface by the direction that it faces.",
      .keys = {
          path_key("irradiance", "{site}_{date}_{time}_irradiance.exr",
                   "File name, relative to the output folder, ending in exr, hdr or ktx2; with "
                   "{face} a cube in six files."),
          numbers_key("Numbers in the file. Default half (ktx2), float (exr, hdr): half numbers "
                      "end above the light of night."),
          {.name = "projection",
           .kind = K::word,
           .words = {"lat-long", "cube"},
           .example = "cube",
           .doc = "Default lat-long; cube for ktx2 and with {face}."},
          size_key("64", "Side of a cube's face, or width of a lat-long map, in pixels."),
          orientation_key("openexr", "How map or faces lie (docs/hdri.md)."),
          disc_key("With the light of the sun's disc."),
      }};
  return spec;
}

const SectionSpec& harmonics_spec() {
  static const SectionSpec spec{
      .name = "harmonics output",
      .doc = "Spherical harmonics of the light, bands 0 to 2.",
      .keys = {
          path_key("harmonics", "{site}_{date}_{time}_sh.json",
                   "File name, relative to the output folder, ending in json."),
          orientation_key("openexr", "Whose axes they are in (docs/hdri.md)."),
          disc_key("With the light of the sun's disc."),
      }};
  return spec;
}

const SectionSpec& sun_light_spec() {
  static const SectionSpec spec{
      .name = "sun output",
      .doc = "The sun as a light of its own, to go with a sky without disc.",
      .keys = {
          path_key("sun", "{site}_{date}_{time}_sun.json",
                   "File name, relative to the output folder, ending in json or usda."),
          orientation_key("openexr (json), usd (usda)", "Whose axes it is in (docs/hdri.md)."),
      }};
  return spec;
}

const SectionSpec& dome_spec() {
  static const SectionSpec spec{
      .name = "dome output",
      .doc = "A USD dome light that shows a map of the job.",
      .keys = {
          path_key("dome", "{site}_{date}_{time}.usda",
                   "File name, relative to the output folder, ending in usda."),
          {.name = "map",
           .kind = K::output_path,
           .required = true,
           .example = "{site}_{date}_{time}.exr",
           .doc = "The map that it shows: the name of an image output, letter by letter, that is a "
                  "scene-linear lat-long map."},
          orientation_key("usd", "Whose world the light stands in (docs/hdri.md)."),
      }};
  return spec;
}

}  // namespace skylapse::config
