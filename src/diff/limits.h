#pragma once
// From numbers to a verdict: limits of measures, profiles of limits, and rules by path.
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "diff/diff_result.h"

namespace skylapse::diff {

/// Values above `warn` warn, values above `fail` fail (of psnr: below). NaN: no limit.
struct Limit {
  double warn = kNone, fail = kNone;
};

/// What rules say of a limit; the other half stays as it is.
struct LimitChange {
  std::optional<double> warn, fail;
};

/// What a check that is no number does when it finds something.
enum class Severity { ignore, warn, fail };

enum class Profile {
  exact,           // every sample the same
  same_renderer,   // one program, one machine or driver: other threads, other order of sums
  cross_renderer,  // other drivers and vector widths, files rounded to halves
  cross_model,     // another model of the same sky: what must stay is where things are
};

/// "exact", "same-renderer", "cross-renderer", "cross-model".
std::string_view name_of(Profile profile);
std::optional<Profile> profile_from_name(std::string_view name);
/// The four names.
std::vector<std::string> profile_names();

struct Limits {
  Profile profile = Profile::cross_renderer;
  std::map<std::string, Limit> measures;  // "region.*.bias" holds for all regions
  std::map<std::string, Severity> checks;
};

/// The limits of a profile; their reasons are in docs/diff.md.
Limits profile_limits(Profile profile);

/// Of a measure; a limit of its own name wins over one of a pattern. No limit: NaN twice.
Limit limit_of(const Limits& limits, const std::string& measure);
Severity severity_of(const Limits& limits, const std::string& check);

/// A measure and what its values are.
struct MeasureKind {
  std::string_view name;  // "region.*.bias" stands for all regions
  std::string_view unit;  // "%": values are fractions, written as percent
  std::string_view meaning;
};
/// All measures, in the order of reports.
const std::vector<MeasureKind>& measure_kinds();
/// The kind of a measure's name, or of a pattern as limits are written by; null: there is none.
const MeasureKind* kind_of(const std::string& measure);

/// All checks that are no numbers.
const std::vector<std::string>& check_names();

/// "0.2 %", "0.002", "off": what a limit of that measure may be, in fractions; nothing if it is
/// none of these, or percent of what is no share.
std::optional<double> parse_limit(std::string_view text, std::string_view unit = "%");

/// Sets what the change sets, of all that the name or pattern covers.
void apply(Limits& limits, const std::string& measure, const LimitChange& change);

/// Of a path: later rules win over earlier ones.
struct PathRule {
  std::string path;  // glob, pairs.h
  bool ignore = false;
  std::optional<Profile> profile;
  std::map<std::string, LimitChange> measures;
  std::map<std::string, Severity> checks;
};

struct Rules {
  std::optional<Profile> profile;
  std::map<std::string, LimitChange> measures;
  std::map<std::string, Severity> checks;
  std::vector<std::string> ignore;  // globs of names that are left out
  std::vector<PathRule> paths;
};

/// The limits of a file of that name: those of the profile, then the rules of everything, then of
/// the paths that fit.
Limits limits_for(const Rules& rules, const std::string& name);
bool is_ignored(const Rules& rules, const std::string& name);

/// Reads a rules file (YAML, docs/diff.md). All errors in one run, with file:line:column.
Result<Rules, Diagnostics> read_rules(const std::string& path);
/// The same of a text; `name` is used in messages.
Result<Rules, Diagnostics> parse_rules(const std::string& text, const std::string& name);

}  // namespace skylapse::diff
