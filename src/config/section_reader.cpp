#include "config/section_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "config/value_reader.h"
#include "core/printable.h"

namespace skylapse::config {
namespace {

std::string in_section(const std::string& path) {
  return path.empty() ? std::string("at the top level") : fmt::format("in {}", path);
}

std::string key_list(const SectionSpec& spec) {
  std::string list;
  for (const KeySpec& key : spec.keys) list += (list.empty() ? "" : ", ") + std::string(key.name);
  return list;
}

/// Returns the key that was probably meant.
std::optional<std::string> report_unknown_key(const MapEntry& entry, const SectionSpec& spec,
                                              const std::string& path, ReadContext& context) {
  std::optional<std::string> nearest;
  if (!context.errors.full() && entry.key.size() <= 40) {
    std::vector<std::string> names;
    for (const KeySpec& key : spec.keys) names.emplace_back(key.name);
    nearest = nearest_name(entry.key, names);
  }
  context.errors.add(
      entry.key_place,
      fmt::format("the key \"{}\" is not known {}", shown(entry.key), in_section(path)),
      nearest ? fmt::format("did you mean {}?", *nearest)
              : fmt::format("known keys: {}", key_list(spec)));
  return nearest;
}

std::string example_line(const KeySpec& key) {
  return key.example.empty() ? fmt::format("add {}", key.name)
                             : fmt::format("add \"{}: {}\"", key.name, key.example);
}

/// `meant` are keys that are there, but for a slip: they are not missing on top.
void report_missing(const Section& section, const std::set<std::string, std::less<>>& meant,
                    ReadContext& context) {
  for (const KeySpec& key : section.spec->keys)
    if (key.required && !section.has(key.name) && !meant.contains(key.name))
      context.errors.add(section.place, fmt::format("{} is missing", section.path_of(key.name)),
                         example_line(key));
  for (const Alternatives& group : section.spec->alternatives) {
    const std::string_view* first = nullptr;
    const bool any_meant = std::any_of(group.keys.begin(), group.keys.end(),
                                       [&](std::string_view key) { return meant.contains(key); });
    for (const std::string_view& name : group.keys) {
      if (!section.has(name)) continue;
      if (first != nullptr)
        context.errors.add(section.field(name)->key_place,
                           fmt::format("{} and {} exclude each other", section.path_of(*first),
                                       section.path_of(name)),
                           fmt::format("use one of {}", fmt::join(group.keys, ", ")));
      else
        first = &name;
    }
    if (group.required && first == nullptr && !any_meant)
      context.errors.add(
          section.place,
          fmt::format("{} lacks one of {}", section.path.empty() ? "the job" : section.path,
                      fmt::join(group.keys, ", ")),
          example_line(*find_key_spec(*section.spec, group.keys.front())));
  }
}

/// One entry of the map on its way to values.
struct FieldReader {
  const KeySpec& key;
  const std::string& path;
  const Place& key_place;
  ReadContext& context;
  std::vector<Value> values{};

  void add_scalar(const Node& node, const std::string& item_path) {
    auto value = read_scalar(node, key, item_path, context);
    if (value)
      values.push_back(std::move(*value));
    else
      context.errors.add(place_of_problem(node, value.error()), value.error().message,
                         value.error().hint);
  }

  void add_section(const Node& node, const SectionSpec& spec, const std::string& item_path,
                   const Place& place) {
    values.push_back(
        {std::make_shared<const Section>(read_section(node, spec, item_path, place, context)),
         node.place});
  }

  /// A section as a day range: first, last, step.
  void add_date_section(const Node& node, const std::string& item_path, const Place& place) {
    const Section section = read_section(node, *key.sections[0], item_path, place, context);
    const auto from = section.get<DateRange>("from"), to = section.get<DateRange>("to");
    const double step = section.get<double>("step").value_or(1);
    if (!from || !to) return;
    if (to->first < from->first)
      context.errors.add(section.place_of("to"), fmt::format("{} ends before it begins", item_path),
                         "write the earlier day first");
    else
      values.push_back({DateRange{from->first, to->first, int(step), {}}, place});
  }

  void wrong_shape(const Node& node, const std::string& item_path, std::string_view wanted) {
    const std::string_view found = node.kind == Node::Kind::map        ? "a section"
                                   : node.kind == Node::Kind::sequence ? "a list"
                                   : node.kind == Node::Kind::scalar   ? "a single value"
                                                                       : "nothing";
    std::string hint = key.example.empty() ? "" : fmt::format("such as {}", key.example);
    if (node.kind == Node::Kind::map && key.kind == ValueKind::output_path)
      hint = "put names with { } in quotes: \"{site}.####.png\"";
    context.errors.add(node.place, fmt::format("{} is {}, not {}", item_path, found, wanted), hint);
  }

  [[nodiscard]] bool takes_section() const {
    return key.kind == ValueKind::section || key.kind == ValueKind::section_list ||
           key.kind == ValueKind::dates || key.kind == ValueKind::view_direction;
  }

  /// Of the sections that an item of a list may be, the one whose first key is there; of several,
  /// the one that knows the first keys of the others too.
  const SectionSpec* choose_section(const Node& node, const std::string& item_path) {
    if (key.sections.size() == 1) return key.sections[0];
    std::vector<const SectionSpec*> there;
    for (const SectionSpec* spec : key.sections)
      if (find_key(node, spec->keys[0].name) != nullptr) there.push_back(spec);
    for (const SectionSpec* spec : there)
      if (std::all_of(there.begin(), there.end(), [&](const SectionSpec* other) {
            return find_key_spec(*spec, other->keys[0].name) != nullptr;
          }))
        return spec;
    if (!there.empty()) return there[0];
    std::vector<std::string> first_keys;
    for (const SectionSpec* spec : key.sections) first_keys.emplace_back(spec->keys[0].name);
    std::string hint =
        fmt::format("such as \"{}: {}\"", first_keys[0], key.sections[0]->keys[0].example);
    for (const MapEntry& entry : node.entries)
      if (const auto nearest =
              entry.key.size() <= 40 ? nearest_name(entry.key, first_keys) : std::nullopt)
        hint = fmt::format("did you mean {} instead of {}?", *nearest, entry.key);
    context.errors.add(node.place,
                       fmt::format("{} lacks one of {}", item_path, fmt::join(first_keys, ", ")),
                       hint);
    return nullptr;
  }

  void add_item(const Node& node, const std::string& item_path, const Place& place) {
    switch (node.kind) {
      case Node::Kind::scalar:
        if (key.kind == ValueKind::section || key.kind == ValueKind::section_list)
          wrong_shape(node, item_path,
                      fmt::format("a section with the keys {}", key_list(*key.sections[0])));
        else
          add_scalar(node, item_path);
        return;
      case Node::Kind::map:
        if (key.kind == ValueKind::dates) {
          add_date_section(node, item_path, place);
        } else if (takes_section()) {
          if (const SectionSpec* spec = choose_section(node, item_path))
            add_section(node, *spec, item_path, place);
        } else {
          wrong_shape(node, item_path, "a single value");
        }
        return;
      case Node::Kind::null:
        if (key.kind == ValueKind::section)  // "air:" with every line below it commented out
          add_section(node, *key.sections[0], item_path, place);
        else
          context.errors.add(node.place, fmt::format("{} has no value", item_path),
                             key.example.empty() ? "" : fmt::format("such as {}", key.example));
        return;
      case Node::Kind::sequence:
        wrong_shape(node, item_path, "a single value");
        return;
    }
  }

  void read(const Node& node) {
    const bool takes_list =
        key.list || key.kind == ValueKind::section_list || key.kind == ValueKind::dates;
    if (node.kind != Node::Kind::sequence || !takes_list) {
      if (key.kind == ValueKind::section_list && node.kind != Node::Kind::null)
        wrong_shape(node, path, "a list");
      else
        add_item(node, path, key_place);
      return;
    }
    if (node.items.empty())
      context.errors.add(node.place, fmt::format("{} is an empty list", path),
                         key.example.empty() ? "" : fmt::format("such as {}", key.example));
    for (size_t i = 0; i < node.items.size(); ++i)
      add_item(node.items[i], fmt::format("{}.{}", path, i), node.items[i].place);
  }
};

}  // namespace

std::vector<std::shared_ptr<const Section>> Section::sections(std::string_view key) const {
  std::vector<std::shared_ptr<const Section>> all;
  for (const Value& value : values(key))
    if (const auto* section = std::get_if<std::shared_ptr<const Section>>(&value.data))
      all.push_back(*section);
  return all;
}

Place place_of_problem(const Node& node, const Problem& problem) {
  Place place = node.place;
  if (problem.length == 0 || !node.verbatim) return place;
  place.column += int(problem.begin);
  place.length = int(problem.length);
  return place;
}

Section read_section(const Node& node, const SectionSpec& spec, const std::string& path,
                     const Place& place, ReadContext& context) {
  Section section;
  section.spec = &spec;
  section.path = path;
  section.place = place;
  std::set<std::string, std::less<>> meant;
  for (const MapEntry& entry : node.entries) {
    const KeySpec* key = find_key_spec(spec, entry.key);
    if (key == nullptr) {
      if (const auto nearest = report_unknown_key(entry, spec, path, context))
        meant.insert(*nearest);
      continue;
    }
    const std::string key_path = section.path_of(key->name);
    FieldReader reader{*key, key_path, entry.key_place, context};
    reader.read(entry.value);
    section.put(key->name, {entry.key_place, entry.value.place, std::move(reader.values)});
  }
  report_missing(section, meant, context);
  return section;
}

}  // namespace skylapse::config
