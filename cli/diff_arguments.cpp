#include "cli/diff_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/arguments.h"
#include "config/quantity_parser.h"
#include "image/camera/camera_words.h"

namespace skylapse::cli {
namespace {

Result<double> parse_value(const std::string& option, const std::string& text,
                           std::string_view unit = "%") {
  const auto value = diff::parse_limit(text, unit);
  if (value) return *value;
  return option_error(option, fmt::format("'{}' is no limit", text),
                      unit == "%" ? "a number from 0 up, with or without %"
                                  : fmt::format("a number from 0 up, no percent{}{}",
                                                unit.empty() ? "" : ": ", unit));
}

/// "relative.rms=0.5 %", "relative.max=1 %,0.2 %" (fail, warn).
Status read_limit(const std::string& text, diff::Rules& rules) {
  const size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  if (diff::kind_of(name) == nullptr) {
    std::vector<std::string> names;
    for (const auto& kind : diff::measure_kinds()) names.emplace_back(kind.name);
    const auto near = nearest_name(name, names);
    return option_error("--limit", fmt::format("unknown measure '{}'", name),
                        near ? fmt::format("did you mean {}?", *near)
                             : fmt::format("known: {}", fmt::join(names, ", ")));
  }
  if (equals == std::string::npos)
    return option_error("--limit", fmt::format("'{}' has no value", text),
                        "write NAME=FAIL or NAME=FAIL,WARN: relative.rms=0.5%");
  const std::string values = text.substr(equals + 1);
  const size_t comma = values.find(',');
  const std::string_view unit = diff::kind_of(name)->unit;
  const auto fail = parse_value("--limit", values.substr(0, comma), unit);
  if (!fail) return fail.error();
  diff::LimitChange limit{.warn = diff::kNone, .fail = *fail};
  if (comma != std::string::npos) {
    const auto warn = parse_value("--limit", values.substr(comma + 1), unit);
    if (!warn) return warn.error();
    if (name != "psnr" && *warn > *fail)
      return option_error("--limit",
                          fmt::format("{}: the warning limit is above the failing one", name),
                          "write NAME=FAIL,WARN");
    limit.warn = *warn;
  }
  rules.measures[name] = limit;
  return Done{};
}

/// "stored-type=fail".
Status read_check(const std::string& text, diff::Rules& rules) {
  const size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const std::string word = equals == std::string::npos ? "" : text.substr(equals + 1);
  const auto& names = diff::check_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    const auto near = nearest_name(name, names);
    return option_error("--check", fmt::format("unknown check '{}'", name),
                        near ? fmt::format("did you mean {}?", *near)
                             : fmt::format("known: {}", fmt::join(names, ", ")));
  }
  if (word != "fail" && word != "warn" && word != "ignore")
    return option_error("--check", fmt::format("'{}' is no severity", word),
                        "allowed: fail, warn, ignore");
  rules.checks[name] = word == "fail"   ? diff::Severity::fail
                       : word == "warn" ? diff::Severity::warn
                                        : diff::Severity::ignore;
  return Done{};
}

Result<diff::Rules, Diagnostics> rules_of(const DiffArguments& a) {
  diff::Rules rules;
  if (!a.rules.empty()) {
    auto read = diff::read_rules(a.rules);
    if (!read) return read.error();
    rules = *std::move(read);
  }
  if (!a.profile.empty()) {
    rules.profile = diff::profile_from_name(a.profile);
    const auto near = nearest_name(a.profile, diff::profile_names());
    if (!rules.profile)
      return Diagnostics{option_error(
          "--profile", fmt::format("'{}' is no profile", a.profile),
          fmt::format("{}allowed: {}", near ? fmt::format("did you mean {}? ", *near) : "",
                      fmt::join(diff::profile_names(), ", ")))};
  }
  for (const std::string& limit : a.limits)
    if (const Status read = read_limit(limit, rules); !read) return Diagnostics{read.error()};
  for (const std::string& check : a.checks)
    if (const Status read = read_check(check, rules); !read) return Diagnostics{read.error()};
  rules.ignore.insert(rules.ignore.end(), a.ignore.begin(), a.ignore.end());
  return rules;
}

/// --fail-above and its companions; nothing if none of them is used.
Result<std::optional<diff::SimpleLimit>> simple_limit_of(const DiffArguments& a) {
  if (a.fail_above.empty() && a.warn_above.empty()) {
    if (a.metric.empty() && a.fail_percent.empty()) return std::optional<diff::SimpleLimit>();
    return option_error(a.metric.empty() ? "--fail-percent" : "--metric",
                        "says nothing without a limit", "add --fail-above E or --warn-above E");
  }
  diff::SimpleLimit simple;
  if (!a.metric.empty()) simple.metric = a.metric;
  const std::vector<std::string> metrics{"relative", "absolute", "flip"};
  if (std::find(metrics.begin(), metrics.end(), simple.metric) == metrics.end())
    return option_error("--metric", fmt::format("'{}' is no measure of pixels", simple.metric),
                        fmt::format("allowed: {}", fmt::join(metrics, ", ")));
  for (const auto& [option, text, target] :
       {std::tuple("--fail-above", &a.fail_above, &simple.fail),
        std::tuple("--warn-above", &a.warn_above, &simple.warn)}) {
    if (text->empty()) continue;
    const auto value = parse_value(option, *text);
    if (!value) return value.error();
    *target = *value;
  }
  if (!a.fail_percent.empty()) {
    const auto percent = config::parse_number(a.fail_percent);
    if (!percent || *percent < 0 || *percent > 100)
      return option_error("--fail-percent", fmt::format("'{}' is no share", a.fail_percent),
                          "allowed: 0 to 100");
    simple.percent = *percent;
  }
  return std::optional(simple);
}

Status read_view(const DiffArguments& a, diff::PairOptions& options) {
  if (!a.projection.empty()) {
    const auto projection = image::projection_from_name(a.projection);
    if (!projection || !image::sees_whole_sphere(*projection))
      return option_error("--projection", fmt::format("'{}' is no map of the sphere", a.projection),
                          "allowed: lat-long, cube, octahedral, mirror-ball");
    options.camera = image::Camera{};
    options.camera->projection = *projection;
  }
  if (a.sun.empty()) return Done{};
  const size_t comma = a.sun.find(',');
  const auto degrees = [](const std::string& text) -> std::optional<double> {
    const auto number = config::parse_number(config::plain_text(text));
    return number ? std::optional(*number) : std::nullopt;
  };
  const auto az = degrees(a.sun.substr(0, comma));
  const auto el = comma == std::string::npos ? std::nullopt : degrees(a.sun.substr(comma + 1));
  if (!az || !el || std::fabs(*az) > 360 || std::fabs(*el) > 90)
    return option_error("--sun", fmt::format("'{}' is no direction", a.sun),
                        "write AZIMUTH,ELEVATION in degrees: 182.5,40.1");
  options.sun = enu_direction(*az * deg, *el * deg);
  return Done{};
}

Status read_flip(const DiffArguments& a, image::FlipOptions& flip) {
  flip.published_exposures = a.published_exposures;
  if (a.tone_mapper == "hable")
    flip.tone_mapper = image::ToneMapper::hable;
  else if (a.tone_mapper == "reinhard")
    flip.tone_mapper = image::ToneMapper::reinhard;
  else if (a.tone_mapper != "aces")
    return option_error("--flip-tone-mapper", fmt::format("'{}' is unknown", a.tone_mapper),
                        "allowed: aces, hable, reinhard");
  if (!a.pixels_per_degree.empty()) {
    const auto ppd = config::parse_number(a.pixels_per_degree);
    if (!ppd || *ppd < 1 || *ppd > 1000)
      return option_error("--flip-ppd", fmt::format("'{}' is out of range", a.pixels_per_degree),
                          "allowed: 1 to 1000 pixels per degree");
    flip.pixels_per_degree = *ppd;
  }
  if (a.exposures.empty()) return Done{};
  // START,STOP,COUNT
  std::vector<double> numbers;
  for (size_t at = 0; at <= a.exposures.size();) {
    const size_t comma = std::min(a.exposures.find(',', at), a.exposures.size());
    const auto number =
        config::parse_number(config::plain_text(a.exposures.substr(at, comma - at)));
    if (number) numbers.push_back(*number);
    at = comma + 1;
  }
  if (numbers.size() != 3 || numbers[0] > numbers[1] || numbers[2] < 1 || numbers[2] > 64 ||
      std::fabs(numbers[0]) > 100 || std::fabs(numbers[1]) > 100)
    return option_error("--flip-exposures", fmt::format("'{}' is no range", a.exposures),
                        "write START,STOP,COUNT in stops: -6,2,5");
  flip.start = numbers[0], flip.stop = numbers[1], flip.exposures = int(numbers[2]);
  return Done{};
}

}  // namespace

Result<diff::DiffOptions, Diagnostics> diff_options_of(const DiffArguments& a) {
  auto rules = rules_of(a);
  if (!rules) return rules.error();
  diff::DiffOptions options;
  options.rules = *std::move(rules);
  auto simple = simple_limit_of(a);
  if (!simple) return Diagnostics{simple.error()};
  options.pair.simple = *simple;
  const bool other_limits = !a.profile.empty() || !options.rules.measures.empty();
  if (*simple && other_limits)
    return Diagnostics{option_error(a.fail_above.empty() ? "--warn-above" : "--fail-above",
                                    "takes the place of a profile and its limits",
                                    "leave out --profile, --limit and the rules' limits, or it")};
  options.pair.flip = !a.no_flip;
  if (const Status view = read_view(a, options.pair); !view) return Diagnostics{view.error()};
  if (const Status flip = read_flip(a, options.pair.flip_options); !flip)
    return Diagnostics{flip.error()};
  if (!a.psnr_peak.empty()) {
    const auto peak = config::parse_number(a.psnr_peak);
    if (!peak || !(*peak > 0))
      return Diagnostics{option_error("--psnr-peak", fmt::format("'{}' is no peak", a.psnr_peak),
                                      "a number above 0")};
    options.pair.psnr_peak = *peak;
  }
  if (a.jobs < 0 || a.jobs > 1024)
    return Diagnostics{option_error("--jobs", fmt::format("{} is out of range", a.jobs),
                                    "allowed: 1 to 1024; 0 for as many as there are cores")};
  options.jobs = a.jobs;
  options.golden_folder = a.golden_folder, options.renderer = a.renderer;
  options.prune = a.prune;
  const bool golden = !a.golden_folder.empty();
  if (golden && !a.b.empty())
    return Diagnostics{option_error("--golden-dir", "takes the place of A",
                                    "write skylapse diff B --golden-dir DIR")};
  if (!golden && (a.update || a.self_check))
    return Diagnostics{option_error(a.update ? "--update-golden" : "--self-check", "needs goldens",
                                    "add --golden-dir DIR")};
  if (a.self_check && (!a.a.empty() || a.update))
    return Diagnostics{option_error("--self-check", "compares goldens with each other alone",
                                    "write skylapse diff --self-check --golden-dir DIR")};
  if (a.prune && !a.update)
    return Diagnostics{option_error("--prune", "belongs to --update-golden", "add it")};
  if (!a.heat_map.empty() && !a.heat_map.ends_with(".png") && !a.heat_map.ends_with(".exr"))
    return Diagnostics{option_error("--heatmap",
                                    fmt::format("'{}' is no picture of ours", a.heat_map),
                                    "a name that ends in .png or .exr")};
  if (a.a.empty() && !a.self_check)
    return Diagnostics{option_error("diff", golden ? "B is missing" : "A and B are missing",
                                    "write skylapse diff A B, or B --golden-dir DIR")};
  if (!golden && a.b.empty())
    return Diagnostics{option_error("diff", "B is missing", "write skylapse diff A B")};
  options.a = golden ? std::string() : a.a, options.b = golden ? a.a : a.b;
  return options;
}

}  // namespace skylapse::cli
