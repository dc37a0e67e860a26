#pragma once
// Air by name: the files of configs/presets, compiled in.
#include <string_view>
#include <vector>

#include "config/source_text.h"
#include "config/yaml_node.h"

namespace skylapse::config {

/// Names of the presets, sorted: the files' names without ".yaml", "_" as a blank, and as a hyphen
/// in a second spelling.
const std::vector<std::string_view>& preset_names();

/// The text of a preset: keys of the section `air`; empty if there is no such preset.
std::string_view preset_text(std::string_view name);

/// Where the config's `air` names a preset, adds the preset's keys that are not written there, or
/// excluded by what is; sections are filled key by key. Unknown names are left to the reader.
void apply_preset(Node& root, SourceSet& sources, ErrorList& errors);

}  // namespace skylapse::config
