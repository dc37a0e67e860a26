#include "config/air_presets.h"

#include <algorithm>

#include "config/key_sections.h"
#include "config/preset_texts.h"
#include "config/yaml_reader.h"
#include "config/yaml_text.h"

namespace skylapse::config {
namespace {

bool excluded(const Node& section, const SectionSpec& spec, const std::string& key) {
  const Alternatives* group = alternatives_of(spec, key);
  return group != nullptr &&
         std::any_of(group->keys.begin(), group->keys.end(),
                     [&](std::string_view other) { return find_key(section, other) != nullptr; });
}

void fill(Node& section, const Node& from, const SectionSpec& spec) {
  const Node written = section;  // keys of the preset do not exclude each other
  for (const MapEntry& entry : from.entries) {
    Node* known = find_key(section, entry.key);
    const KeySpec* key = find_key_spec(spec, entry.key);
    if (known == nullptr) {
      if (!excluded(written, spec, entry.key)) section.entries.push_back(entry);
    } else if (key != nullptr && key->kind == ValueKind::section &&
               entry.value.kind == Node::Kind::map &&
               (known->kind == Node::Kind::map || known->kind == Node::Kind::null)) {
      known->kind = Node::Kind::map;
      fill(*known, entry.value, *key->sections[0]);
    }
  }
}

std::string hyphenated(std::string_view name) {
  std::string word(name);
  std::replace(word.begin(), word.end(), ' ', '-');
  return word;
}

}  // namespace

const std::vector<std::string_view>& preset_names() {
  static const std::vector<std::string> spellings = [] {
    std::vector<std::string> all;
    for (const auto& [name, text] : kPresetTexts) {
      all.emplace_back(name);
      if (name.find(' ') != std::string_view::npos) all.push_back(hyphenated(name));
    }
    std::sort(all.begin(), all.end());
    return all;
  }();
  static const std::vector<std::string_view> names(spellings.begin(), spellings.end());
  return names;
}

std::string_view preset_text(std::string_view name) {
  for (const auto& preset : kPresetTexts)
    if (preset.first == name || hyphenated(preset.first) == name) return preset.second;
  return {};
}

void apply_preset(Node& root, SourceSet& sources, ErrorList& errors) {
  Node* air = find_key(root, "air");
  const Node* name = air == nullptr ? nullptr : find_key(*air, "preset");
  if (name == nullptr || name->kind != Node::Kind::scalar) return;
  const std::string_view text = preset_text(name->text);
  if (text.empty()) return;
  const int source = sources.add("preset " + name->text, normalised_text(std::string(text)));
  const auto preset = read_yaml(sources, source, errors);
  if (preset) fill(*air, *preset, air_spec());
}

}  // namespace skylapse::config
