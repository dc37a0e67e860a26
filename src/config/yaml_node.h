#pragma once
// A parsed YAML document as the config sees it: aliases expanded, every value with its place.
#include <string>
#include <vector>

#include "config/source_text.h"

namespace skylapse::config {

struct MapEntry;

struct Node {
  enum class Kind { null, scalar, sequence, map };
  Kind kind = Kind::null;
  std::string text;               // scalar
  bool quoted = false;            // scalar in quotes, or a block scalar
  bool verbatim = false;          // `text` stands in the source, letter by letter, at `place`
  Place place;                    // null without text: the place of its key
  std::vector<Node> items;        // sequence
  std::vector<MapEntry> entries;  // map, in the order of the file, keys unique
};

struct MapEntry {
  std::string key;
  Place key_place;
  Node value;
};

/// The value of `key` in a map; null pointer if the node is no map or has no such key.
const Node* find_key(const Node& node, std::string_view key);
Node* find_key(Node& node, std::string_view key);

}  // namespace skylapse::config
