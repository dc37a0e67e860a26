#pragma once
// What a config may hold, as data: one row for each key. Reading, unknown keys, overrides, the JSON
// Schema and the key reference in the docs all follow from these rows.
#include <string_view>
#include <vector>

#include "config/units.h"

namespace skylapse::config {

enum class ValueKind {
  number,  // dimensionless
  integer,
  quantity,  // number and unit
  on_off,
  word,  // one of `words`
  text,
  file,         // an existing file, relative to the config's folder
  output_path,  // a template with {tokens} and ####
  zone,         // IANA name or offset
  date,
  dates,           // a day, a range, {from, to, step}, or a list of these
  time,            // a time expression
  image_size,      // 1920x1080, or 512 for a cube face
  azimuth,         // an angle or a compass point
  view_direction,  // {azimuth, elevation, roll}, a compass point, zenith or nadir
  albedo,          // 0..1, or the name of a measured ground
  section,         // a map with the keys of sections[0]
  section_list,    // a list of maps; the section whose first key is present is meant
};

struct SectionSpec;

struct KeySpec {
  std::string_view name;
  ValueKind kind = ValueKind::text;
  Dimension dimension = Dimension::none;
  std::string_view min{}, max{};  // inclusive, as a user would write them
  std::vector<std::string_view> words{};
  bool list = false;  // one value, or a list of values
  bool required = false;
  std::vector<const SectionSpec*> sections{};
  std::string_view default_text{};  // what holds when the key is absent; empty: see doc
  std::string_view example{};
  std::string_view doc{};
};

/// Keys that say the same thing in different ways.
struct Alternatives {
  std::vector<std::string_view> keys;
  bool required = false;  // exactly one of them; otherwise at most one
};

struct SectionSpec {
  std::string_view name;  // "camera"
  std::string_view doc{};
  std::vector<KeySpec> keys{};
  std::vector<Alternatives> alternatives{};
};

const KeySpec* find_key_spec(const SectionSpec& section, std::string_view key);
const Alternatives* alternatives_of(const SectionSpec& section, std::string_view key);

/// The whole config.
const SectionSpec& job_spec();

}  // namespace skylapse::config
