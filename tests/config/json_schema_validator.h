#pragma once
// The part of JSON Schema (draft 2020-12) that the config's schema uses. A keyword it does not
// know is reported as an error, so that nothing is passed over in silence.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace skylapse::config::test {

/// What is wrong with `instance` under `schema`; empty if it is valid. Paths are JSON pointers.
std::vector<std::string> schema_violations(const nlohmann::json& schema,
                                           const nlohmann::json& instance);

/// A YAML text as JSON, by the YAML 1.2 core schema: plain true/false, null, integers and floats
/// are typed, all else is text. This is what editors hand to a schema.
nlohmann::json yaml_to_json(const std::string& text);

}  // namespace skylapse::config::test
