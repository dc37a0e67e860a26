// The table of keys as JSON Schema. What a schema can say without knowing units is said: kinds,
// names, words, units as patterns, ranges of plain numbers. Ranges of quantities are in the
// descriptions, and checked by the reader.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "config/key_spec.h"
#include "config/quantity_parser.h"
#include "config/time_expression.h"
#include "config/value_reader.h"
#include "sky/ground_albedo.h"

namespace skylapse::config {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kNumber = R"([+-]?\s*([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?)";
constexpr std::string_view kDate = R"([0-9]{4}-[0-9]{1,2}-[0-9]{1,2})";

std::string escaped(std::string_view text) {
  std::string pattern;
  for (const char c : text) {
    if (std::string_view("/.*+?()[]{}|^$\\").find(c) != std::string_view::npos) pattern += '\\';
    pattern += c;
  }
  return pattern;
}

std::string units_pattern(Dimension dimension) {
  std::string any;
  for (const UnitName& unit : info_of(dimension).units)
    any += (any.empty() ? "" : "|") + escaped(unit.symbol);
  return any;
}

/// "235 m"; sums, letters for the hemisphere and plain numbers where the dimension has them.
std::string quantity_pattern(Dimension dimension) {
  const DimensionInfo& info = info_of(dimension);
  std::string term = fmt::format(R"({}\s*({}))", kNumber, units_pattern(dimension));
  if (!info.bare_unit.empty()) term += "?";
  if (info.compound) term = fmt::format(R"(({}\s*)+)", term);
  if (dimension == Dimension::latitude) term = fmt::format(R"(([NS]\s*)?{}(\s*[NS])?)", term);
  if (dimension == Dimension::longitude) term = fmt::format(R"(([EW]\s*)?{}(\s*[EW])?)", term);
  return fmt::format(R"(^\s*{}\s*$)", term);
}

Json text_like(const std::string& pattern) { return {{"type", "string"}, {"pattern", pattern}}; }

Json quantity_schema(const KeySpec& key) {
  Json text = text_like(quantity_pattern(key.dimension));
  if (info_of(key.dimension).bare_unit.empty()) return text;
  // The bounds are written in the unit that plain numbers have.
  const auto bound = [&](std::string_view written) {
    return *parse_quantity(written, key.dimension) / info_of(key.dimension).units[0].factor;
  };
  const auto tidy = [](double value) { return std::stod(fmt::format("{:.9g}", value)); };
  return {
      {"anyOf",
       {{{"type", "number"}, {"minimum", tidy(bound(key.min))}, {"maximum", tidy(bound(key.max))}},
        text}}};
}

std::string time_pattern() {
  const std::string clock =
      R"([0-9]{1,2}:[0-9]{2}(:[0-9]{2}(\.[0-9]*)?)?(\s*(Z|UTC|[+-][0-9]{1,2}(:?[0-9]{2})?))?)";
  const std::string shift =
      fmt::format(R"(\s*[+-]\s*({}\s*({})\s*)+)", R"([0-9.]+)", units_pattern(Dimension::duration));
  return fmt::format(R"(^\s*({}[T ]\s*)?({}|{})({})?\s*$)", kDate, clock,
                     fmt::join(anchor_names(), "|"), shift);
}

Json reference(const SectionSpec& spec) {
  std::string name(spec.name);
  for (char& c : name)
    if (c == ' ') c = '_';
  return {{"$ref", "#/$defs/" + name}};
}

Json enumeration(const auto& words) {
  Json list = Json::array();
  for (const auto& word : words) list.push_back(std::string(word));
  return {{"enum", list}};
}

Json word_or(const std::vector<std::string>& words, Json other) {
  return {{"anyOf", {enumeration(words), std::move(other)}}};
}

/// One value of a key; lists of it follow in value_schema.
Json item_schema(const KeySpec& key) {
  const auto number = [&](const char* type) -> Json {
    return {
        {"type", type}, {"minimum", *parse_number(key.min)}, {"maximum", *parse_number(key.max)}};
  };
  switch (key.kind) {
    case ValueKind::number:
      return number("number");
    case ValueKind::integer: {
      Json schema{{"type", "integer"}};
      schema["minimum"] = *parse_integer(key.min);
      schema["maximum"] = *parse_integer(key.max);
      return schema;
    }
    case ValueKind::quantity:
      return quantity_schema(key);
    case ValueKind::on_off:
      return {{"enum", {true, false, "on", "off", "yes", "no"}}};
    case ValueKind::word:
      return enumeration(key.words);
    case ValueKind::text:
    case ValueKind::file:
      return {{"type", {"string", "number"}}, {"minLength", 1}};
    case ValueKind::zone:
      return {{"type", "string"}, {"minLength", 1}};
    case ValueKind::output_path:
      return text_like(R"(^.*[^/]$)");
    case ValueKind::date:
      return text_like(fmt::format(R"(^\s*{}\s*$)", kDate));
    case ValueKind::dates:
      return {{"anyOf",
               {text_like(fmt::format(R"(^\s*{0}(\s*\.\.\s*{0})?\s*$)", kDate)),
                reference(*key.sections[0])}}};
    case ValueKind::time:
      return text_like(time_pattern());
    case ValueKind::image_size:
      return {{"anyOf",
               {text_like(R"(^\s*[0-9]+(\s*[xX]\s*[0-9]+)?\s*$)"),
                {{"type", "integer"}, {"minimum", 1}, {"maximum", 65536}}}}};
    case ValueKind::azimuth:
      return word_or(compass_words(), quantity_schema(key));
    case ValueKind::view_direction:
      return word_or(view_words(), reference(*key.sections[0]));
    case ValueKind::albedo:
      return word_or(sky::ground_albedo_names(), number("number"));
    case ValueKind::section: {
      // An empty section is the same as none.
      return {{"anyOf", {reference(*key.sections[0]), {{"type", "null"}}}}};
    }
    case ValueKind::section_list: {
      Json any = Json::array();
      for (const SectionSpec* spec : key.sections) any.push_back(reference(*spec));
      return key.sections.size() == 1 ? any[0] : Json{{"anyOf", any}};
    }
  }
  return {};
}

Json value_schema(const KeySpec& key) {
  const Json item = item_schema(key);
  const Json list{{"type", "array"}, {"items", item}, {"minItems", 1}};
  if (key.kind == ValueKind::section_list) return list;
  if (key.list || key.kind == ValueKind::dates) return {{"anyOf", {item, list}}};
  return item;
}

std::string description(const KeySpec& key) {
  std::string text(key.doc);
  if (key.kind == ValueKind::quantity || key.kind == ValueKind::azimuth)
    text += fmt::format(" Units: {}.", unit_list(key.dimension));
  if (!key.min.empty()) text += fmt::format(" Allowed: {} to {}.", key.min, key.max);
  if (!key.default_text.empty()) text += fmt::format(" Default: {}.", key.default_text);
  return text;
}

Json present(std::string_view key) { return {{"required", {std::string(key)}}}; }

/// Exactly one of the keys, or at most one.
Json alternatives_schema(const Alternatives& group) {
  Json any = Json::array(), one = Json::array();
  for (const std::string_view key : group.keys) {
    any.push_back(present(key));
    one.push_back(present(key));
  }
  if (!group.required) one.push_back({{"not", {{"anyOf", any}}}});
  return {{"oneOf", one}};
}

Json section_schema(const SectionSpec& spec) {
  Json properties = Json::object(), required = Json::array(), all = Json::array();
  for (const KeySpec& key : spec.keys) {
    Json schema{{"description", description(key)}};
    schema.update(value_schema(key));
    properties[std::string(key.name)] = schema;
    if (key.required) required.push_back(std::string(key.name));
  }
  for (const Alternatives& group : spec.alternatives) all.push_back(alternatives_schema(group));
  Json schema{{"description", std::string(spec.doc)},
              {"type", "object"},
              {"additionalProperties", false},
              {"properties", properties}};
  if (!required.empty()) schema["required"] = required;
  if (!all.empty()) schema["allOf"] = all;
  return schema;
}

void collect_definitions(const SectionSpec& spec, Json& definitions) {
  for (const KeySpec& key : spec.keys)
    for (const SectionSpec* below : key.sections) {
      const std::string name = reference(*below)["$ref"].get<std::string>().substr(8);
      if (definitions.contains(name)) continue;
      definitions[name] = section_schema(*below);
      collect_definitions(*below, definitions);
    }
}

}  // namespace

std::string job_json_schema() {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "skylapse job"}};
  schema.update(section_schema(job_spec()));
  Json definitions = Json::object();
  collect_definitions(job_spec(), definitions);
  schema["$defs"] = definitions;
  return schema.dump(2) + "\n";
}

}  // namespace skylapse::config
