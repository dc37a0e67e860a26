#pragma once
// What can be learned from the text of a YAML file itself, beside the parser.
#include <optional>
#include <string>
#include <string_view>

#include "config/source_text.h"

namespace skylapse::config {

/// How a scalar is written on its line.
struct ScalarExtent {
  size_t begin = 0;       // bytes of anchor and tag before it
  size_t length = 1;      // quotes included; of its first line if there are several
  bool quotes = false;    // written in quotes
  bool closed = true;     // and the quotes end on the line
  bool verbatim = false;  // the value stands there as it is: no escapes, no folded lines
};

/// `rest` is the line from the scalar's mark on, `value` what the parser made of it.
ScalarExtent scalar_extent(std::string_view rest, std::string_view value);

struct BadByte {
  size_t offset;
  std::string what;
};
/// The first byte that no text file in UTF-8 holds: a control character or broken encoding.
std::optional<BadByte> first_bad_byte(std::string_view text);

Place place_of_byte(const SourceSet& sources, int source, size_t offset);

}  // namespace skylapse::config
