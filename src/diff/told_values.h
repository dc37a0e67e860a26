#pragma once
// Single values that a file tells of itself, in whatever way its format can hold them.
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "output/image_writer.h"

namespace skylapse::diff {

/// Attributes of a file first, then the entry of its manifest. PNG holds attributes as text, so
/// numbers are read from text too. Everything that is not there, of another type, or no finite
/// number is nothing.
class ToldValues {
 public:
  /// Both outlive this; `manifest_entry` may be null.
  ToldValues(const std::vector<output::Attribute>& attributes, const nlohmann::json* manifest_entry)
      : attributes_(attributes), entry_(manifest_entry) {}

  /// `pointer`: JSON pointer (RFC 6901) into the entry; empty: the manifest does not know it.
  [[nodiscard]] std::optional<double> number(const char* attribute, const char* pointer = "") const;
  [[nodiscard]] std::string text(const char* attribute, const char* pointer = "") const;
  /// Numbers of a list; empty unless all are finite.
  [[nodiscard]] std::vector<double> numbers(const char* attribute, const char* pointer = "") const;

 private:
  [[nodiscard]] const output::Attribute* find(const char* attribute) const;
  [[nodiscard]] const nlohmann::json* find_in_manifest(const char* pointer) const;
  const std::vector<output::Attribute>& attributes_;
  const nlohmann::json* entry_;
};

}  // namespace skylapse::diff
