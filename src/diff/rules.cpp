// The rules file: limits by path, in YAML.
#include <fmt/format.h>

#include <algorithm>

#include "config/quantity_parser.h"
#include "config/text_file.h"
#include "config/yaml_reader.h"
#include "core/printable.h"
#include "diff/limits.h"

namespace skylapse::diff {
namespace {

using config::Node;
using Kind = Node::Kind;

std::vector<std::string> measure_names() {
  std::vector<std::string> names;
  for (const MeasureKind& kind : measure_kinds()) names.emplace_back(kind.name);
  return names;
}

class RulesReader {
 public:
  explicit RulesReader(config::ErrorList& errors) : errors_(errors) {}

  Rules read(const Node& root) {
    Rules rules;
    if (root.kind == Kind::null) return rules;
    if (!is_map(root, "the rules file")) return rules;
    check_keys(root, {"profile", "limits", "checks", "ignore", "paths"});
    read_common(root, rules);
    if (const Node* ignore = find_key(root, "ignore")) rules.ignore = globs(*ignore);
    if (const Node* paths = find_key(root, "paths")) read_paths(*paths, rules);
    return rules;
  }

 private:
  config::ErrorList& errors_;

  bool is_map(const Node& node, const std::string& what) {
    if (node.kind == Kind::map) return true;
    errors_.add(node.place, what + " is no map", "write `key: value` pairs");
    return false;
  }

  void check_keys(const Node& map, const std::vector<std::string>& known) {
    for (const config::MapEntry& entry : map.entries) {
      if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
      const auto near = nearest_name(entry.key, known);
      errors_.add(entry.key_place, fmt::format("unknown key '{}'", shown(entry.key)),
                  near ? fmt::format("did you mean {}?", *near)
                       : fmt::format("known: {}", fmt::join(known, ", ")));
    }
  }

  template <class Target>
  void read_common(const Node& map, Target& target) {
    if (const Node* profile = find_key(map, "profile")) target.profile = read_profile(*profile);
    if (const Node* limits = find_key(map, "limits")) read_limits(*limits, target.measures);
    if (const Node* checks = find_key(map, "checks")) read_checks(*checks, target.checks);
  }

  std::optional<Profile> read_profile(const Node& node) {
    const auto profile = node.kind == Kind::scalar ? profile_from_name(node.text) : std::nullopt;
    if (profile) return profile;
    const auto near = nearest_name(node.text, profile_names());
    errors_.add(node.place, fmt::format("'{}' is no profile", shown(node.text)),
                fmt::format("{}allowed: {}", near ? fmt::format("did you mean {}? ", *near) : "",
                            fmt::join(profile_names(), ", ")));
    return {};
  }

  void read_limits(const Node& node, std::map<std::string, LimitChange>& limits) {
    if (!is_map(node, "limits")) return;
    for (const config::MapEntry& entry : node.entries) {
      if (kind_of(entry.key) == nullptr) {
        const auto near = nearest_name(entry.key, measure_names());
        errors_.add(
            entry.key_place, fmt::format("unknown measure '{}'", shown(entry.key)),
            near ? fmt::format("did you mean {}?", *near) : "known measures: skylapse diff --help");
        continue;
      }
      limits[entry.key] = read_limit(entry.key, entry.value);
    }
  }

  /// A plain value fails; nothing warns then.
  LimitChange read_limit(const std::string& measure, const Node& node) {
    if (node.kind != Kind::map) return {kNone, read_number(measure, node)};
    check_keys(node, {"warn", "fail"});
    LimitChange change;
    const Node *warn = find_key(node, "warn"), *fail = find_key(node, "fail");
    if (warn != nullptr) change.warn = read_number(measure, *warn);
    if (fail != nullptr) change.fail = read_number(measure, *fail);
    if (measure != "psnr" && change.warn && change.fail && *change.warn > *change.fail)
      errors_.add(warn->place, "the warning limit is above the failing one",
                  "exchange them: warn comes first");
    return change;
  }

  double read_number(const std::string& measure, const Node& node) {
    const std::string_view unit = kind_of(measure)->unit;
    const auto value = node.kind == Kind::scalar ? parse_limit(node.text, unit) : std::nullopt;
    if (value) return *value;
    errors_.add(node.place, fmt::format("'{}' is no limit of {}", shown(node.text), measure),
                unit == "%" ? std::string("a number from 0 up, with or without %, or off")
                            : fmt::format("a number from 0 up{}{}, or off",
                                          unit.empty() ? "" : ", in ", unit));
    return kNone;
  }

  void read_checks(const Node& node, std::map<std::string, Severity>& checks) {
    if (!is_map(node, "checks")) return;
    check_keys(node, check_names());
    for (const config::MapEntry& entry : node.entries) {
      const std::string& word = entry.value.text;
      if (word == "fail" || word == "warn" || word == "ignore")
        checks[entry.key] = word == "fail"   ? Severity::fail
                            : word == "warn" ? Severity::warn
                                             : Severity::ignore;
      else
        errors_.add(entry.value.place, fmt::format("'{}' is no severity", shown(word)),
                    "allowed: fail, warn, ignore");
    }
  }

  std::string glob(const Node& node) {
    if (node.kind == Kind::scalar && !node.text.empty()) return node.text;
    errors_.add(node.place, "a path is missing here", "write a pattern such as \"**/*.png\"");
    return {};
  }

  std::vector<std::string> globs(const Node& node) {
    if (node.kind != Kind::sequence) return {glob(node)};
    std::vector<std::string> all;
    for (const Node& item : node.items) all.push_back(glob(item));
    return all;
  }

  void read_paths(const Node& node, Rules& rules) {
    if (node.kind != Kind::sequence) {
      errors_.add(node.place, "paths is no list", "write `- path: \"*.png\"` and its limits");
      return;
    }
    for (const Node& item : node.items) {
      if (!is_map(item, "an item of paths")) continue;
      check_keys(item, {"path", "ignore", "profile", "limits", "checks"});
      PathRule rule;
      const Node* path = find_key(item, "path");
      if (path == nullptr)
        errors_.add(item.place, "an item of paths has no path", "write path: \"**/*.png\"");
      else
        rule.path = glob(*path);
      if (const Node* ignore = find_key(item, "ignore")) rule.ignore = read_flag(*ignore);
      read_common(item, rule);
      rules.paths.push_back(std::move(rule));
    }
  }

  bool read_flag(const Node& node) {
    if (node.text == "true" || node.text == "false") return node.text == "true";
    errors_.add(node.place, fmt::format("'{}' is neither true nor false", shown(node.text)));
    return false;
  }
};

}  // namespace

Result<Rules, Diagnostics> parse_rules(const std::string& text, const std::string& name) {
  config::SourceSet sources;
  config::ErrorList errors;
  const int source = sources.add(name, config::normalised_text(text));
  const auto root = config::read_yaml(sources, source, errors);
  Rules rules;
  if (root) rules = RulesReader(errors).read(*root);
  if (!errors.empty()) return errors.diagnostics(sources);
  return rules;
}

Result<Rules, Diagnostics> read_rules(const std::string& path) {
  const auto text = config::read_text_file(path, "rules");
  if (!text) return text.error();
  return parse_rules(*text, path);
}

}  // namespace skylapse::diff
