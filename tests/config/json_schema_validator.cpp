#include "config/json_schema_validator.h"

#include <cmath>
#include <regex>
#include <set>
#include <stdexcept>

#include "config/yaml_reader.h"

namespace skylapse::config::test {
namespace {

using nlohmann::json;

class Validator {
 public:
  explicit Validator(const json& root) : root_(root) {}

  void check(const json& schema, const json& value, const std::string& path) {
    refuse_unknown_keywords(schema, path);
    if (schema.contains("$ref")) check(resolve(schema["$ref"]), value, path);
    check_type(schema, value, path);
    check_value(schema, value, path);
    check_number(schema, value, path);
    check_text(schema, value, path);
    check_array(schema, value, path);
    check_object(schema, value, path);
    check_combinations(schema, value, path);
  }

  std::vector<std::string> violations;

 private:
  void fail(const std::string& path, const std::string& what) {
    violations.push_back((path.empty() ? "/" : path) + ": " + what);
  }

  [[nodiscard]] bool valid(const json& schema, const json& value) const {
    Validator inner(root_);
    inner.check(schema, value, "");
    return inner.violations.empty();
  }

  [[nodiscard]] const json& resolve(const std::string& reference) const {
    if (!reference.starts_with("#"))
      throw std::runtime_error("only local references: " + reference);
    return root_.at(json::json_pointer(reference.substr(1)));
  }

  void refuse_unknown_keywords(const json& schema, const std::string& path) {
    static const std::set<std::string> known{
        "$schema",     "$defs",      "$ref",      "title",
        "description", "type",       "enum",      "minimum",
        "maximum",     "pattern",    "minLength", "items",
        "minItems",    "properties", "required",  "additionalProperties",
        "anyOf",       "oneOf",      "allOf",     "not"};
    for (const auto& [keyword, unused] : schema.items())
      if (!known.contains(keyword)) fail(path, "the validator does not know " + keyword);
  }

  static bool has_type(const json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "null") return value.is_null();
    if (type == "number") return value.is_number();
    if (type == "integer")
      return value.is_number_integer() ||
             (value.is_number() && std::floor(value.get<double>()) == value.get<double>());
    throw std::runtime_error("unknown type " + type);
  }

  void check_type(const json& schema, const json& value, const std::string& path) {
    if (!schema.contains("type")) return;
    const json& type = schema["type"];
    bool found = false;
    for (const json& one : type.is_array() ? type : json::array({type}))
      found = found || has_type(value, one);
    if (!found) fail(path, "type is not " + type.dump());
  }

  void check_value(const json& schema, const json& value, const std::string& path) {
    if (!schema.contains("enum")) return;
    for (const json& one : schema["enum"])
      if (one == value) return;
    fail(path, value.dump() + " is not in the enumeration");
  }

  void check_number(const json& schema, const json& value, const std::string& path) {
    if (!value.is_number()) return;
    if (schema.contains("minimum") && value < schema["minimum"]) fail(path, "below the minimum");
    if (schema.contains("maximum") && value > schema["maximum"]) fail(path, "above the maximum");
  }

  void check_text(const json& schema, const json& value, const std::string& path) {
    if (!value.is_string()) return;
    const auto& text = value.get_ref<const std::string&>();
    if (schema.contains("minLength") && text.size() < schema["minLength"].get<size_t>())
      fail(path, "too short");
    if (schema.contains("pattern") &&
        !std::regex_search(
            text, std::regex(schema["pattern"].get<std::string>(), std::regex::ECMAScript)))
      fail(path, "\"" + text + "\" does not match the pattern");
  }

  void check_array(const json& schema, const json& value, const std::string& path) {
    if (!value.is_array()) return;
    if (schema.contains("minItems") && value.size() < schema["minItems"].get<size_t>())
      fail(path, "too few items");
    if (schema.contains("items"))
      for (size_t i = 0; i < value.size(); ++i)
        check(schema["items"], value[i], path + "/" + std::to_string(i));
  }

  void check_object(const json& schema, const json& value, const std::string& path) {
    if (!value.is_object()) return;
    if (schema.contains("required"))
      for (const json& key : schema["required"])
        if (!value.contains(key.get<std::string>())) fail(path, "lacks " + key.get<std::string>());
    const json properties = schema.value("properties", json::object());
    for (const auto& [key, item] : value.items()) {
      if (properties.contains(key))
        check(properties[key], item, path + "/" + key);
      else if (schema.value("additionalProperties", true) == false)
        fail(path, "does not know " + key);
    }
  }

  void check_combinations(const json& schema, const json& value, const std::string& path) {
    if (schema.contains("allOf"))
      for (const json& one : schema["allOf"]) check(one, value, path);
    const auto matches = [&](const char* keyword) {
      long count = 0;
      for (const json& one : schema[keyword]) count += valid(one, value) ? 1 : 0;
      return count;
    };
    if (schema.contains("anyOf") && matches("anyOf") == 0) fail(path, "matches none of anyOf");
    if (schema.contains("oneOf") && matches("oneOf") != 1)
      fail(path, "does not match exactly one of oneOf");
    if (schema.contains("not") && valid(schema["not"], value))
      fail(path, "matches what is excluded");
  }

  const json& root_;
};

json scalar_to_json(const Node& node) {
  static const std::regex integer(R"([-+]?[0-9]+)");
  static const std::regex number(R"([-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?)");
  if (node.quoted) return node.text;
  if (node.text == "true" || node.text == "false") return node.text == "true";
  if (std::regex_match(node.text, integer)) return std::stoll(node.text);
  if (std::regex_match(node.text, number)) return std::stod(node.text);
  return node.text;
}

json to_json(const Node& node) {
  json value;
  switch (node.kind) {
    case Node::Kind::null:
      return nullptr;
    case Node::Kind::scalar:
      return scalar_to_json(node);
    case Node::Kind::sequence:
      value = json::array();
      for (const Node& item : node.items) value.push_back(to_json(item));
      return value;
    case Node::Kind::map:
      value = json::object();
      for (const MapEntry& entry : node.entries) value[entry.key] = to_json(entry.value);
      return value;
  }
  return value;
}

}  // namespace

std::vector<std::string> schema_violations(const json& schema, const json& instance) {
  Validator validator(schema);
  validator.check(schema, instance, "");
  return validator.violations;
}

json yaml_to_json(const std::string& text) {
  SourceSet sources;
  ErrorList errors;
  sources.add("yaml", normalised_text(text));
  const auto root = read_yaml(sources, 0, errors);
  if (!root || !errors.empty()) throw std::runtime_error("not YAML");
  return to_json(*root);
}

}  // namespace skylapse::config::test
