#pragma once
// Names of files: their order and the sequences they form. Bytes of any kind, as file systems
// allow.
#include <string>
#include <string_view>
#include <vector>

namespace skylapse::diff {

/// Whether `a` comes before `b` with runs of digits counted as numbers: f.9 before f.10. A strict
/// total order: names of equal numbers (f.1, f.01) are ordered by their bytes.
bool comes_before(std::string_view a, std::string_view b);

/// For each name the number of its sequence, from 0; -1: alone. A sequence is two or more names
/// that differ in one number only (of several that differ: in the last), where a time such as
/// 2026-06-21T10-30 or 2026-06-21_103000 counts as one number.
std::vector<int> sequences_of(const std::vector<std::string>& names);

}  // namespace skylapse::diff
