#pragma once
// From nodes to checked values, by the table of keys. Knows kinds, units and ranges; what values
// mean together is the matter of build_job.
#include <cassert>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "config/job_config.h"
#include "config/key_spec.h"
#include "config/yaml_node.h"

namespace skylapse::config {

class Section;

struct PixelSize {
  int width = 0;
  int height = 0;  // 0: one number was written, the side of a cube face
};

struct Value {
  std::variant<double, long, bool, std::string, PixelSize, TimeExpression, DateRange, Albedo,
               std::shared_ptr<const Section>>
      data;
  Place place;
};

/// Values of the keys of one map. A key that is present with a bad value is kept without values,
/// so that its absence is not reported on top.
class Section {
 public:
  struct Field {
    Place key_place;
    Place value_place;
    std::vector<Value> values;
  };

  const SectionSpec* spec = nullptr;
  std::string path;  // "cameras.1", empty for the root
  Place place;       // where the section is introduced

  void put(std::string_view key, Field field) { fields_[std::string(key)] = std::move(field); }
  /// The key is written in the file, well or badly.
  [[nodiscard]] bool has(std::string_view key) const { return field(key) != nullptr; }
  [[nodiscard]] const Field* field(std::string_view key) const {
    assert(find_key_spec(*spec, key) != nullptr);
    const auto it = fields_.find(key);
    return it == fields_.end() ? nullptr : &it->second;
  }
  /// The place of the value, or of the section if the key is absent.
  [[nodiscard]] Place place_of(std::string_view key) const {
    const Field* f = field(key);
    return f == nullptr ? place : f->value_place;
  }
  /// "cameras.1.fov"
  [[nodiscard]] std::string path_of(std::string_view key) const {
    return path.empty() ? std::string(key) : path + "." + std::string(key);
  }
  /// The value of a key; nothing if it is absent or was wrong.
  template <class T>
  [[nodiscard]] std::optional<T> get(std::string_view key) const {
    const Field* f = field(key);
    if (f == nullptr || f->values.empty()) return std::nullopt;
    const T* value = std::get_if<T>(&f->values.front().data);
    return value == nullptr ? std::nullopt : std::optional<T>(*value);
  }
  [[nodiscard]] const std::vector<Value>& values(std::string_view key) const {
    static const std::vector<Value> none;
    const Field* f = field(key);
    return f == nullptr ? none : f->values;
  }
  /// The sections under a key of kind section or section_list.
  [[nodiscard]] std::vector<std::shared_ptr<const Section>> sections(std::string_view key) const;

 private:
  std::map<std::string, Field, std::less<>> fields_;
};

/// What reading needs beside the nodes.
struct ReadContext {
  const SourceSet& sources;
  ErrorList& errors;
  std::string folder;                   // of the config file, for files named in it
  std::set<std::string> known_zones{};  // found before: libraries repeat few zones often
};

/// Reads a map by its spec: unknown, missing and conflicting keys, kinds, units and ranges are
/// reported. `place` is where the section is introduced.
Section read_section(const Node& node, const SectionSpec& spec, const std::string& path,
                     const Place& place, ReadContext& context);

/// Where in `node` a problem lies: the part of the text that it names, if it is written verbatim.
Place place_of_problem(const Node& node, const Problem& problem);

}  // namespace skylapse::config
