#pragma once
#include <string>

namespace skylapse::config {

/// The table of keys as Markdown, one table a section: the generated part of docs/config.md.
std::string key_reference_markdown();

/// The same for atmosphere files.
std::string atmosphere_reference_markdown();

}  // namespace skylapse::config
