// The top of the table of keys. A new key is a row here or in one of the other *_keys, a field
// in the struct that it fills, and a line in the build_ function of its section.
#include "config/key_sections.h"

namespace skylapse::config {
namespace {

using K = ValueKind;

}  // namespace

const KeySpec* find_key_spec(const SectionSpec& section, std::string_view key) {
  for (const KeySpec& spec : section.keys)
    if (spec.name == key) return &spec;
  return nullptr;
}

const Alternatives* alternatives_of(const SectionSpec& section, std::string_view key) {
  for (const Alternatives& group : section.alternatives)
    for (const std::string_view name : group.keys)
      if (name == key) return &group;
  return nullptr;
}

const SectionSpec& job_spec() {
  static const SectionSpec spec{
      .name = "",
      .doc = "A job.",
      .keys =
          {
              {.name = "title",
               .kind = K::text,
               .example = "Prague, summer solstice",
               .doc = "A line about the job, kept in the manifest."},
              {.name = "location",
               .kind = K::section,
               .sections = {&site_spec()},
               .example = "{latitude: 50.0755 deg, longitude: 14.4378 deg}",
               .doc = "The place."},
              {.name = "locations",
               .kind = K::section_list,
               .sections = {&site_spec()},
               .doc = "Several places."},
              {.name = "time",
               .kind = K::section,
               .required = true,
               .sections = {&time_spec()},
               .example = "{zone: Europe/Prague, date: 2026-06-21, step: 10 min}",
               .doc = "Which moments are rendered."},
              {.name = "air",
               .kind = K::section,
               .sections = {&air_spec()},
               .doc = "The air and the ground."},
              {.name = "sky",
               .kind = K::section,
               .sections = {&sky_spec()},
               .doc = "How the sky is computed."},
              {.name = "camera",
               .kind = K::section,
               .sections = {&camera_spec()},
               .example = "{look_at: west, size: 1280x720}",
               .doc = "The camera."},
              {.name = "cameras",
               .kind = K::section_list,
               .sections = {&camera_spec()},
               .doc = "Several cameras."},
              {.name = "exposure",
               .kind = K::section,
               .sections = {&exposure_spec()},
               .doc = "Exposure of display-referred images."},
              {.name = "color",
               .kind = K::section,
               .sections = {&color_spec()},
               .doc = "Colour spaces."},
              {.name = "outputs",
               .kind = K::section_list,
               .required = true,
               .sections = {&image_spec(), &movie_spec(), &specular_spec(), &irradiance_spec(),
                            &harmonics_spec(), &sun_light_spec(), &dome_spec(), &gallery_spec(),
                            &sheet_spec()},
               .example = "[{image: sky.####.png}]",
               .doc = "What is written: a list of images, of what renderers want beside them, of "
                      "movies, and of what shows the whole job."},
              {.name = "allow_outside_paths",
               .kind = K::on_off,
               .default_text = "off",
               .example = "on",
               .doc = "Lets outputs leave the output folder."},
          },
      .alternatives = {{{"location", "locations"}, true}, {{"camera", "cameras"}, true}}};
  return spec;
}

}  // namespace skylapse::config
