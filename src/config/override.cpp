#include "config/override.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "config/key_spec.h"
#include "config/quantity_parser.h"
#include "config/yaml_reader.h"
#include "config/yaml_text.h"
#include "core/printable.h"

namespace skylapse::config {
namespace {

struct Segment {
  std::string name;
  Place place;
};

std::vector<Segment> split(const std::string& key_path, int source) {
  std::vector<Segment> segments;
  for (size_t begin = 0; begin <= key_path.size();) {
    const size_t end = std::min(key_path.find('.', begin), key_path.size());
    segments.push_back({key_path.substr(begin, end - begin),
                        {source, 1, int(begin) + 1, int(std::max<size_t>(end - begin, 1))}});
    begin = end + 1;
  }
  return segments;
}

/// Reads the value with the key blanked out before it, so that columns count from the key's first
/// letter; messages then show both.
std::optional<Node> read_value(const Override& change, int source, SourceSet& sources,
                               ErrorList& errors) {
  const std::string value = normalised_text(change.value);
  sources.set_text(source, std::string(change.key_path.size() + 1, ' ') + value);
  auto node = read_yaml(sources, source, errors);
  sources.set_text(source, change.key_path + "=" + value);
  return node;
}

constexpr const char* kKeyExamples = "such as air.turbidity=3 or outputs.0.type=half";

/// The key path without its empty parts, as a hint.
std::string without_empty_parts(const std::vector<Segment>& segments) {
  std::string path;
  for (const Segment& segment : segments)
    if (!segment.name.empty()) path += (path.empty() ? "" : ".") + segment.name;
  return path.empty() ? kKeyExamples : fmt::format("did you mean {}=...?", shown(path));
}

/// Marks the part of `path` that is wrong.
std::optional<Problem> key_path_problem(const std::string& path,
                                        const std::vector<Segment>& segments) {
  if (int(segments.size()) > YamlLimits{}.depth)
    return Problem{"this key has too many parts", kKeyExamples, 0, 1};
  if (const auto bad = first_bad_byte(path)) return Problem{bad->what, kKeyExamples, 0, 1};
  if (path.find('\n') != std::string::npos)
    return Problem{"the key holds a line end", kKeyExamples, 0, 1};
  for (const Segment& segment : segments)
    if (segment.name.empty())
      return Problem{path.empty() ? "there is no key before the ="
                                  : fmt::format("a key is missing in \"{}\"", shown(path)),
                     without_empty_parts(segments), size_t(segment.place.column) - 1, 1};
  return std::nullopt;
}

void remove_alternatives(Node& map, const SectionSpec* spec, const std::string& key) {
  const Alternatives* group = spec == nullptr ? nullptr : alternatives_of(*spec, key);
  if (group == nullptr) return;
  std::erase_if(map.entries, [&](const MapEntry& entry) {
    // Two overrides that exclude each other are left for the reader to report.
    return entry.key != key && entry.value.place.source == 0 &&
           std::find(group->keys.begin(), group->keys.end(), entry.key) != group->keys.end();
  });
}

/// The spec of a section or of an item of a list of sections under `key`; null for other values.
const SectionSpec* spec_below(const KeySpec* key, const Node& below) {
  if (key == nullptr || key->sections.empty()) return nullptr;
  for (const SectionSpec* candidate : key->sections)
    if (find_key(below, candidate->keys[0].name) != nullptr) return candidate;
  return key->sections[0];
}

/// The item of a list that a segment names; null after an error.
Node* list_item(Node& list, const Segment& segment, ErrorList& errors) {
  const auto index = parse_integer(segment.name);
  if (index && *index >= 0 && size_t(*index) < list.items.size()) return &list.items[*index];
  errors.add(
      segment.place, fmt::format("the list has no item {}", shown(segment.name)),
      list.items.empty() ? "it is empty" : fmt::format("allowed: 0 to {}", list.items.size() - 1));
  return nullptr;
}

/// The value under a key of a map, made if it is not there; null after an error.
Node* map_value(Node& map, const Segment& segment, ErrorList& errors) {
  if (map.kind == Node::Kind::null) map.kind = Node::Kind::map;
  if (map.kind != Node::Kind::map) {
    errors.add(segment.place,
               fmt::format("\"{}\" names a part of a single value", shown(segment.name)),
               "set the whole value");
    return nullptr;
  }
  if (Node* known = find_key(map, segment.name)) return known;
  map.entries.push_back({segment.name, segment.place, {}});
  map.entries.back().value.place = segment.place;
  return &map.entries.back().value;
}

}  // namespace

void apply_override(Node& root, const Override& change, SourceSet& sources, ErrorList& errors) {
  const int source =
      sources.add("--set " + printable(beginning(change.key_path, 100)), change.key_path + "=");
  const std::vector<Segment> segments = split(change.key_path, source);
  if (const auto problem = key_path_problem(change.key_path, segments)) {
    errors.add({source, 1, int(problem->begin) + 1, int(problem->length)}, problem->message,
               problem->hint);
    return;
  }
  auto value = read_value(change, source, sources, errors);
  if (!value) return;
  if (value->kind == Node::Kind::null) value->place = segments.back().place;

  Node* node = &root;
  const SectionSpec* spec = &job_spec();  // of `node`, where it is a section
  const KeySpec* key = nullptr;           // that `node` stands under
  for (size_t i = 0; i < segments.size(); ++i) {
    const Segment& segment = segments[i];
    if (node->kind == Node::Kind::sequence) {
      node = list_item(*node, segment, errors);
    } else {
      if (i + 1 == segments.size()) remove_alternatives(*node, spec, segment.name);
      key = spec == nullptr ? nullptr : find_key_spec(*spec, segment.name);
      node = map_value(*node, segment, errors);
    }
    if (node == nullptr) return;
    spec = spec_below(key, *node);
  }
  *node = std::move(*value);
}

}  // namespace skylapse::config
