#pragma once
// From numbers to a verdict: limits of measures, profiles of limits, and rules by path.
#include <map>
#include <string>
#include <vector>

#include "core/result.h"
#include "diff/diff_result.h"

namespace skylapse::diff {

struct Limit {
  double warn = kNone, fail = kNone;  // NaN: none
};

/// Whether a check that is no number fails, warns or is passed over.
enum class Severity { ignore, warn, fail };

enum class Profile { exact, same_renderer, cross_renderer, cross_model };

/// "exact", "same-renderer", "cross-renderer", "cross-model".
std::string_view name_of(Profile profile);

struct Limits {
  Profile profile = Profile::cross_renderer;
  std::map<std::string, Limit> measures;   // by name; "region.*.bias" holds for all regions
  std::map<std::string, Severity> checks;  // "size", "nan", "metadata.sun"
};

/// The limits of a profile, each with its reason in docs/diff.md.
Limits profile_limits(Profile profile);

/// Of a path: later rules win over earlier ones.
struct PathRule {
  std::string path;  // glob, pairs.h
  bool ignore = false;
  std::optional<Profile> profile;
  std::map<std::string, Limit> measures;
  std::map<std::string, Severity> checks;
};

struct Rules {
  Limits limits;                // of everything
  std::vector<PathRule> paths;  // by path
};

Limits limits_for(const Rules& rules, const std::string& name);

/// Reads a rules file (YAML, docs/diff.md). All errors in one run, with file:line:column.
Result<Rules, Diagnostics> read_rules(const std::string& path);

}  // namespace skylapse::diff
