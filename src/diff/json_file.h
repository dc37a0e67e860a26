#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/result.h"

namespace skylapse::diff {

/// A JSON file of at most 512 MiB and 64 levels. Errors: missing_input with line and column.
Result<nlohmann::json> read_json(const std::filesystem::path& path);

/// A text of JSON, likewise; `name` is that of the file in messages.
Result<nlohmann::json> parse_json(std::string_view text, const std::string& name);

/// Whether a path is relative and stays below the folder it starts from.
bool stays_below(const std::string& path);

}  // namespace skylapse::diff
