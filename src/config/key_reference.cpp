#include "config/key_reference.h"

#include <fmt/format.h>

#include <vector>

#include "config/atmosphere_file.h"
#include "config/key_spec.h"
#include "config/value_reader.h"

namespace skylapse::config {
namespace {

std::string cell(std::string_view text) {
  std::string safe;
  for (const char c : text) safe += c == '|' ? std::string("\\|") : std::string(1, c);
  return safe;
}

std::string code(std::string_view text) {
  return text.empty() ? std::string() : fmt::format("`{}`", cell(text));
}

std::string kind_text(const KeySpec& key) {
  switch (key.kind) {
    case ValueKind::number:
      return "number";
    case ValueKind::integer:
      return "whole number";
    case ValueKind::quantity:
      return fmt::format(
          "{} in {}", info_of(key.dimension).name.substr(info_of(key.dimension).name.find(' ') + 1),
          unit_list(key.dimension));
    case ValueKind::on_off:
      return "on or off";
    case ValueKind::word:
      return "word";
    case ValueKind::text:
      return "text";
    case ValueKind::file:
      return "file";
    case ValueKind::output_path:
      return "file name";
    case ValueKind::zone:
      return "time zone";
    case ValueKind::date:
      return "day";
    case ValueKind::dates:
      return "days";
    case ValueKind::time:
      return "time";
    case ValueKind::image_size:
      return "pixels";
    case ValueKind::azimuth:
      return fmt::format("compass point, or angle in {}", unit_list(key.dimension));
    case ValueKind::view_direction:
      return "direction";
    case ValueKind::albedo:
      return "number or name";
    case ValueKind::section:
      return "section";
    case ValueKind::section_list:
      return "list of sections";
  }
  return {};
}

std::string row(const KeySpec& key, const SectionSpec& section) {
  std::string need = key.required ? "required" : code(key.default_text);
  if (const Alternatives* group = alternatives_of(section, key.name)) {
    std::string others;
    for (const std::string_view name : group->keys)
      if (name != key.name) others += fmt::format("{}`{}`", others.empty() ? "" : ", ", name);
    need += fmt::format("{}{} {}", need.empty() ? "" : "; ",
                        group->required ? "required, or" : "excludes", others);
  }
  const std::string kind = kind_text(key) + (key.list ? ", or a list" : "");
  return fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key.name, cell(kind),
                     cell(allowed_values(key)), need, code(key.example), cell(key.doc));
}

void append_section(const SectionSpec& section, const std::string& heading, std::string& text,
                    std::vector<const SectionSpec*>& done) {
  for (const SectionSpec* known : done)
    if (known == &section) return;
  done.push_back(&section);
  text += fmt::format(
      "### {}\n\n{}\n\n| key | value | allowed | default | example | meaning |\n"
      "|---|---|---|---|---|---|\n",
      heading, section.doc);
  for (const KeySpec& key : section.keys) text += row(key, section);
  text += "\n";
  for (const KeySpec& key : section.keys)
    for (const SectionSpec* below : key.sections)
      append_section(*below, std::string(below->name), text, done);
}

}  // namespace

std::string key_reference_markdown() {
  std::string text;
  std::vector<const SectionSpec*> done;
  append_section(job_spec(), "top level", text, done);
  return text;
}

std::string atmosphere_reference_markdown() {
  std::string text;
  std::vector<const SectionSpec*> done;
  append_section(atmosphere_spec(), "top level of an atmosphere", text, done);
  return text;
}

}  // namespace skylapse::config
