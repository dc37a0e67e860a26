#pragma once
// Numbers and quantities as people write them: "235 m", "2 h 30 min", `50°04'32"N`.
#include <string>
#include <string_view>

#include "config/source_text.h"
#include "config/units.h"
#include "core/result.h"

namespace skylapse::config {

/// A decimal number, the whole text: no unit, no nan, no infinity, no digit groups. Independent of
/// the locale; numbers that no double can hold are refused.
Result<double, Problem> parse_number(std::string_view text);

/// A whole number, the whole text.
Result<long, Problem> parse_integer(std::string_view text);

/// A quantity in the base unit of its dimension (which has units: not `none`). A missing unit is an
/// error that shows the value with the usual unit, except where the dimension has a unit for plain
/// numbers. Angles and durations may be sums with falling units, each part less than one of the
/// unit before it. Latitudes and longitudes may end (or begin) with a letter N, S, E or W instead
/// of a sign.
Result<double, Problem> parse_quantity(std::string_view text, Dimension dimension);

/// Typographic blanks and the minus sign U+2212 as ASCII, blanks trimmed at both ends.
std::string plain_text(std::string_view text);

}  // namespace skylapse::config
