#pragma once
#include <string>

#include "core/result.h"

namespace skylapse::config {

/// The text of a YAML file, at most one byte more than YamlLimits allow (the reader then says so).
/// Missing files, folders, pipes and unreadable files are errors of their own (missing_input);
/// `what` is the file's kind in hints, "config".
Result<std::string, Diagnostics> read_text_file(const std::string& path, const std::string& what);

}  // namespace skylapse::config
