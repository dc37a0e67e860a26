#include "diff/limits.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "config/quantity_parser.h"
#include "diff/pairs.h"

namespace skylapse::diff {
namespace {

constexpr std::array<std::string_view, 4> kProfiles{"exact", "same-renderer", "cross-renderer",
                                                    "cross-model"};

/// Whether a name like "relative.region.zenith.bias" fits "relative.region.*.bias".
bool fits(std::string_view name, std::string_view pattern) {
  const size_t star = pattern.find('*');
  if (star == std::string_view::npos) return name == pattern;
  const auto head = pattern.substr(0, star), tail = pattern.substr(star + 1);
  return name.size() > head.size() + tail.size() && name.starts_with(head) && name.ends_with(tail);
}

Limits exact() {
  Limits limits;
  for (const char* name :
       {"relative.max", "display.max", "relative.other_channels", "display.other_channels"})
    limits.measures[name] = {kNone, 0};
  return limits;
}

/// Limits in which a bulk of `share` (a fraction; for displays `codes`) is what may differ: single
/// pixels by more, since rounding concentrates at edges; sums over many by less.
void set_scaled(Limits& limits, double share, double codes) {
  const auto set = [&](const std::string& name, double warn, double fail) {
    limits.measures["relative." + name] = {share * warn, share * fail};
  };
  set("max", 1, 5);
  set("other_channels", 1, 5);
  set("rms", 0.3, 1);
  set("weighted_rms", 0.3, 1);
  set("bias", 0.3, 1);
  set("block_rms", 0.5, 2);
  set("row_rms", 0.5, 1.5);
  set("column_rms", 0.5, 1.5);
  set("region.*.rms", 0.5, 2);
  set("region.*.bias", 0.5, 1.5);
  limits.measures["irradiance"] = {0.5 * share, 1.5 * share};
  limits.measures["harmonics"] = {0.5 * share, 1.5 * share};
  const auto set_codes = [&](const std::string& name, double warn, double fail) {
    limits.measures["display." + name] = {codes * warn, codes * fail};
  };
  set_codes("max", 1, 1.5);
  set_codes("other_channels", 1, 1.5);
  set_codes("rms", 0.3, 0.8);
  set_codes("weighted_rms", 0.3, 0.8);
  set_codes("bias", 0.05, 0.15);
  set_codes("block_rms", 0.8, 1.05);
  set_codes("row_rms", 0.6, 0.95);
  set_codes("column_rms", 0.6, 0.95);
  set_codes("region.*.rms", 0.6, 1.05);
  set_codes("region.*.bias", 0.15, 0.3);
}

Limits same_renderer() {
  Limits limits;
  set_scaled(limits, 2e-5, 0.5);
  limits.measures["chromaticity"] = {1e-5, 5e-5};
  limits.measures["position.shift_px"] = {0.01, 0.05};
  limits.measures["sun.shift_deg"] = {0.0005, 0.002};
  limits.measures["sun.flux"] = {1e-5, 1e-4};
  limits.measures["flip.mean"] = {0.0005, 0.002};
  limits.measures["sequence.flicker"] = {2e-5, 1e-4};
  limits.measures["sequence.flicker_codes"] = {0.2, 0.5};
  return limits;
}

Limits cross_renderer() {
  Limits limits;
  set_scaled(limits, 2e-3, 1);
  limits.measures["chromaticity"] = {5e-4, 2e-3};
  limits.measures["position.shift_px"] = {0.05, 0.2};
  limits.measures["sun.shift_deg"] = {0.005, 0.02};
  limits.measures["sun.flux"] = {2e-3, 1e-2};
  limits.measures["flip.mean"] = {0.005, 0.02};
  limits.measures["sequence.flicker"] = {8e-4, 2e-3};
  limits.measures["sequence.flicker_codes"] = {0.3, 0.75};
  return limits;
}

/// Between what models differ by (irradiance 0.83, harmonics 0.72, the disc's place 0.011 deg and
/// flux 0.86, chromaticity 0.11) and what is broken (turned by a column 0.7 deg, the disc gone
/// 1, black 1). FLIP sees as much between models, 0.93, as in any broken picture, so it has no
/// limit. benchmarks/diff/models.py prints the table.
Limits cross_model() {
  Limits limits;
  limits.measures["irradiance"] = {0.9, 0.97};  // a factor of 10, and of 33
  limits.measures["harmonics"] = {0.8, 0.95};
  limits.measures["chromaticity"] = {0.13, 0.17};
  limits.measures["sun.shift_deg"] = {0.02, 0.08};
  limits.measures["sun.flux"] = {0.9, 0.95};
  return limits;
}

}  // namespace

std::string_view name_of(Profile profile) { return kProfiles[size_t(profile)]; }

std::optional<Profile> profile_from_name(std::string_view name) {
  const auto at = std::find(kProfiles.begin(), kProfiles.end(), name);
  if (at == kProfiles.end()) return {};
  return Profile(at - kProfiles.begin());
}

std::vector<std::string> profile_names() { return {kProfiles.begin(), kProfiles.end()}; }

Limits profile_limits(Profile profile) {
  const auto made = [&] {
    switch (profile) {
      case Profile::exact:
        return exact();
      case Profile::same_renderer:
        return same_renderer();
      case Profile::cross_renderer:
        return cross_renderer();
      case Profile::cross_model:
        break;
    }
    return cross_model();
  };
  Limits limits = made();
  limits.profile = profile;
  for (const std::string& check : check_names()) limits.checks[check] = Severity::fail;
  limits.checks["folder.extra"] = Severity::warn;
  limits.checks["manifest"] = Severity::warn;
  limits.checks["odd-reference"] = Severity::warn;
  limits.checks["stored-type"] = profile == Profile::exact ? Severity::fail : Severity::warn;
  if (profile == Profile::cross_model) {
    // Another model may be darker than the gamut's edge where this one was not, and brighter by
    // what a sky gains in a few frames.
    limits.checks["sequence.order"] = Severity::warn;
    limits.checks["negative"] = Severity::warn;
    limits.checks["metadata.content"] = Severity::warn;
  }
  return limits;
}

Limit limit_of(const Limits& limits, const std::string& measure) {
  if (const auto own = limits.measures.find(measure); own != limits.measures.end())
    return own->second;
  for (const auto& [pattern, limit] : limits.measures)
    if (fits(measure, pattern)) return limit;
  return {};
}

Severity severity_of(const Limits& limits, const std::string& check) {
  const auto found = limits.checks.find(check);
  return found == limits.checks.end() ? Severity::fail : found->second;
}

const std::vector<MeasureKind>& measure_kinds() {
  static const std::vector<MeasureKind> kinds{
      {"relative.max", "%", "largest error of a pixel, as a share of its light"},
      {"relative.p50", "%", "error that half of the pixels stay within"},
      {"relative.p95", "%", "error that 95 % of the pixels stay within"},
      {"relative.p99", "%", "error that 99 % of the pixels stay within"},
      {"relative.p999", "%", "error that 99.9 % of the pixels stay within"},
      {"relative.rms", "%", "root mean square of the pixels' errors"},
      {"relative.weighted_rms", "%", "the same, pixels counted by their solid angle"},
      {"relative.bias", "%", "mean error with its sign, of the worst channel"},
      {"relative.block_rms", "%", "root mean square of the worst 8 x 8 pixels"},
      {"relative.row_rms", "%", "root mean square of the worst row"},
      {"relative.column_rms", "%", "root mean square of the worst column"},
      {"relative.other_channels", "%", "largest error of channels that are no colours"},
      {"relative.region.*.rms", "%", "root mean square of a region of the sky"},
      {"relative.region.*.bias", "%", "mean error with its sign of a region, worst channel"},
      {"display.max", "code values", "largest error of a pixel in 8-bit code values"},
      {"display.p50", "code values", "error that half of the pixels stay within"},
      {"display.p95", "code values", "error that 95 % of the pixels stay within"},
      {"display.p99", "code values", "error that 99 % of the pixels stay within"},
      {"display.p999", "code values", "error that 99.9 % of the pixels stay within"},
      {"display.rms", "code values", "root mean square of the pixels' errors"},
      {"display.weighted_rms", "code values", "the same, pixels counted by their solid angle"},
      {"display.bias", "code values", "mean error with its sign, of the worst channel"},
      {"display.block_rms", "code values", "root mean square of the worst 8 x 8 pixels"},
      {"display.row_rms", "code values", "root mean square of the worst row"},
      {"display.column_rms", "code values", "root mean square of the worst column"},
      {"display.other_channels", "code values", "largest error of channels that are no colours"},
      {"display.region.*.rms", "code values", "root mean square of a region of the sky"},
      {"display.region.*.bias", "code values", "mean error with its sign of a region"},
      {"absolute.max", "", "largest difference, in the picture's unit or in code values"},
      {"absolute.mean", "", "mean difference"},
      {"absolute.rms", "", "root mean square difference"},
      {"psnr", "dB", "peak signal to noise ratio of values limited to 0 .. psnr.peak"},
      {"psnr.peak", "", "the peak it is taken on"},
      {"irradiance", "%", "difference of the light on level ground, of the worst channel"},
      {"harmonics", "%", "difference of the light of the sphere in nine spherical harmonics"},
      {"chromaticity", "", "largest distance of mean colours in CIE 1976 u', v'"},
      {"negative.share", "%", "difference of the shares of negative samples"},
      {"exposure.shift_ev", "EV", "the whole picture brighter (positive) or darker"},
      {"position.shift_px", "px", "the whole picture moved"},
      {"position.right_px", "px", "of that, to the right"},
      {"position.down_px", "px", "of that, down"},
      {"position.shift_deg", "deg", "the move, in the middle of the picture"},
      {"sun.shift_px", "px", "the sun's disc moved"},
      {"sun.shift_deg", "deg", "the sun's disc moved"},
      {"sun.flux", "%", "difference of the light of the sun's disc"},
      {"flip.mean", "", "mean of the FLIP map"},
      {"flip.weighted_median", "", "its median, weighted by the errors"},
      {"flip.max", "", "its maximum"},
      {"sequence.flicker", "%", "second difference in time of a region's error"},
      {"sequence.flicker_codes", "code values", "the same of display pictures"},
      {"pixels.above", "%", "share of pixels whose error is above the limit of the command line"},
  };
  return kinds;
}

const MeasureKind* kind_of(const std::string& measure) {
  for (const MeasureKind& kind : measure_kinds())
    if (kind.name == measure || fits(measure, kind.name)) return &kind;
  return nullptr;
}

const std::vector<std::string>& check_names() {
  static const std::vector<std::string> names{"size",
                                              "identical",
                                              "channels",
                                              "parts",
                                              "nan",
                                              "inf",
                                              "negative",
                                              "odd-reference",
                                              "stored-type",
                                              "metadata.sun",
                                              "metadata.units",
                                              "metadata.projection",
                                              "metadata.site",
                                              "metadata.orientation",
                                              "metadata.time",
                                              "metadata.content",
                                              "sequence.missing",
                                              "sequence.extra",
                                              "sequence.order",
                                              "sequence.repeated",
                                              "folder.extra",
                                              "manifest",
                                              "golden-changed",
                                              "self-check"};
  return names;
}

std::optional<double> parse_limit(std::string_view text, std::string_view unit) {
  const std::string plain = config::plain_text(text);
  if (plain == "off" || plain == "none") return kNone;
  const bool percent = plain.ends_with('%');
  const auto number =
      config::parse_number(config::plain_text(percent ? plain.substr(0, plain.size() - 1) : plain));
  if (!number || *number < 0 || (percent && unit != "%")) return {};
  return percent ? *number / 100 : *number;
}

void apply(Limits& limits, const std::string& measure, const LimitChange& change) {
  limits.measures.try_emplace(measure, limit_of(limits, measure));
  for (auto& [name, limit] : limits.measures) {
    if (name != measure && !fits(name, measure)) continue;
    limit.warn = change.warn.value_or(limit.warn);
    limit.fail = change.fail.value_or(limit.fail);
  }
}

Limits limits_for(const Rules& rules, const std::string& name) {
  std::optional<Profile> profile = rules.profile;
  for (const PathRule& rule : rules.paths)
    if (rule.profile && fits_glob(name, rule.path)) profile = rule.profile;
  Limits limits = profile_limits(profile.value_or(Profile::cross_renderer));
  const auto apply_all = [&](const auto& measures, const auto& checks) {
    for (const auto& [measure, change] : measures) apply(limits, measure, change);
    for (const auto& [check, severity] : checks) limits.checks[check] = severity;
  };
  apply_all(rules.measures, rules.checks);
  for (const PathRule& rule : rules.paths)
    if (fits_glob(name, rule.path)) apply_all(rule.measures, rule.checks);
  return limits;
}

bool is_ignored(const Rules& rules, const std::string& name) {
  bool ignored = std::any_of(rules.ignore.begin(), rules.ignore.end(),
                             [&](const std::string& glob) { return fits_glob(name, glob); });
  for (const PathRule& rule : rules.paths)
    if (fits_glob(name, rule.path)) ignored = ignored || rule.ignore;
  return ignored;
}

}  // namespace skylapse::diff
