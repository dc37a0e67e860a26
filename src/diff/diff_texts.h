#pragma once
#include <string_view>

namespace skylapse::diff {

/// A file of src/diff/web by its name, compiled in; empty where there is no such file.
std::string_view diff_text(std::string_view name);

}  // namespace skylapse::diff
