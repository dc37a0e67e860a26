#pragma once
// One scalar to one value, by the row of its key.
#include "config/section_reader.h"

namespace skylapse::config {

/// Kinds that are maps or lists are not handled here (section, section_list, dates).
Result<Value, Problem> read_scalar(const Node& node, const KeySpec& key, const std::string& path,
                                   ReadContext& context);

/// "-500 m to 100 km", "one of auto, hosek-wilkie": what a key takes, for hints and docs; empty if
/// anything goes.
std::string allowed_values(const KeySpec& key);

/// The compass points.
std::vector<std::string> compass_words();

/// Words that a view direction may be: the compass points, zenith and nadir.
std::vector<std::string> view_words();

}  // namespace skylapse::config
