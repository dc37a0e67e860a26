#pragma once
// The only part that sees yaml-cpp. Reads one document into our own nodes, within fixed bounds.
#include <optional>
#include <string>

#include "config/yaml_node.h"

namespace skylapse::config {

/// Bounds on what a text may expand to. A year of hand-written times fits; alias bombs do not.
struct YamlLimits {
  size_t bytes = 1 << 18;       // of the text
  int depth = 24;               // of nesting
  size_t nodes = 100'000;       // aliases expanded
  size_t text_bytes = 1 << 22;  // of all scalars together, aliases expanded
  size_t scalar_bytes = 4096;   // of one scalar
};

/// What the text looks like on disk: removes a byte order mark and turns CR LF and CR into LF.
std::string normalised_text(std::string text);

/// Reads text `source` of `sources`. Duplicate keys, tags, keys that are no words, a second
/// document and everything beyond the limits are errors, added to `errors`. Nothing is returned if
/// the text is no YAML (one error with its place) or a bound is exceeded; an empty text gives a
/// null node.
std::optional<Node> read_yaml(const SourceSet& sources, int source, ErrorList& errors,
                              const YamlLimits& limits = {});

}  // namespace skylapse::config
