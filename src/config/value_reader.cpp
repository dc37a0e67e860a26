#include "config/value_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "astro/time/zone.h"
#include "config/path_template.h"
#include "config/quantity_parser.h"
#include "config/time_expression.h"
#include "config/words.h"
#include "core/printable.h"
#include "core/quantity.h"
#include "sky/ground_albedo.h"

namespace skylapse::config {
namespace {

constexpr size_t kLongestText = 200;
constexpr size_t kLongestZone = 40;  // the longest IANA name has 32 letters
constexpr int kLongestSide = 65536;

std::vector<std::string> strings(const std::vector<std::string_view>& views) {
  return {views.begin(), views.end()};
}

/// "; did you mean x?", or nothing.
std::string slip(const std::string& word, const std::vector<std::string>& candidates) {
  if (word.size() > 40) return {};
  const auto nearest = nearest_name(word, candidates);
  return nearest ? fmt::format("; did you mean {}?", *nearest) : std::string{};
}

double bound(const KeySpec& key, std::string_view text) {
  const auto value = parse_quantity(text, key.dimension);
  assert(value.ok());
  return *value;
}

/// The number of `text` with another unit of the dimension that brings it into range. Not for
/// durations and angles: a number fits some unit of them whatever was meant.
std::string other_unit(std::string_view text, const KeySpec& key, double low, double high) {
  const std::string plain = plain_text(text);
  const size_t end = plain.find_last_of("0123456789.");
  if (end == std::string::npos) return {};
  const std::string number = plain.substr(0, end + 1);
  if (!parse_number(number).ok() || key.dimension == Dimension::latitude ||
      key.dimension == Dimension::longitude || key.dimension == Dimension::angle ||
      key.dimension == Dimension::duration)
    return {};
  for (const UnitName& unit : info_of(key.dimension).units) {
    const std::string candidate = fmt::format("{} {}", number, unit.symbol);
    const auto value = parse_quantity(candidate, key.dimension);
    if (unit.listed && value && *value >= low && *value <= high)
      return fmt::format("; did you mean {}?", candidate);
  }
  return {};
}

Result<Value, Problem> read_quantity(const Node& node, const KeySpec& key,
                                     const std::string& path) {
  const auto parsed = parse_quantity(node.text, key.dimension);
  if (!parsed)
    return Problem{fmt::format("{}: {}", path, parsed.error().message), parsed.error().hint};
  const double low = bound(key, key.min), high = bound(key, key.max);
  if (*parsed < low || *parsed > high)
    return Problem{
        fmt::format("{} = {} is out of range", path, shown(node.text)),
        fmt::format("allowed: {}{}", allowed_values(key), other_unit(node.text, key, low, high))};
  if (key.dimension == Dimension::days && *parsed != std::floor(*parsed))
    return Problem{fmt::format("{} = {} is no whole number of days", path, shown(node.text))};
  return Value{*parsed, node.place};
}

Result<Value, Problem> read_number(const Node& node, const KeySpec& key, const std::string& path) {
  const auto parsed = parse_number(node.text);
  if (!parsed)
    return Problem{fmt::format("{}: {}", path, parsed.error().message), parsed.error().hint};
  if (*parsed < *parse_number(key.min) || *parsed > *parse_number(key.max))
    return Problem{fmt::format("{} = {} is out of range", path, shown(node.text)),
                   fmt::format("allowed: {}", allowed_values(key))};
  return Value{*parsed, node.place};
}

Result<Value, Problem> read_integer(const Node& node, const KeySpec& key, const std::string& path) {
  const auto parsed = parse_integer(node.text);
  if (!parsed)
    return Problem{fmt::format("{}: {}", path, parsed.error().message),
                   fmt::format("allowed: {}", allowed_values(key))};
  if (*parsed < *parse_integer(key.min) || *parsed > *parse_integer(key.max))
    return Problem{fmt::format("{} = {} is out of range", path, shown(node.text)),
                   fmt::format("allowed: {}", allowed_values(key))};
  return Value{*parsed, node.place};
}

Result<Value, Problem> read_on_off(const Node& node, const std::string& path) {
  const std::string& t = node.text;
  if (t == "on" || t == "true" || t == "yes") return Value{true, node.place};
  if (t == "off" || t == "false" || t == "no") return Value{false, node.place};
  return Problem{fmt::format("{} = {} is neither on nor off", path, shown(t)), "allowed: on, off"};
}

Result<Value, Problem> read_word(const Node& node, const KeySpec& key, const std::string& path) {
  if (std::find(key.words.begin(), key.words.end(), node.text) != key.words.end())
    return Value{node.text, node.place};
  return Problem{
      fmt::format("{} = {} is not known", path, shown(node.text)),
      fmt::format("allowed: {}{}", allowed_values(key), slip(node.text, strings(key.words)))};
}

Result<Value, Problem> read_text(const Node& node, const std::string& path) {
  if (node.text.empty()) return Problem{fmt::format("{} is empty", path)};
  if (node.text.size() > kLongestText)
    return Problem{fmt::format("{} has {} characters", path, node.text.size()),
                   fmt::format("allowed: at most {}", kLongestText)};
  if (node.text.find('\n') != std::string::npos)
    return Problem{fmt::format("{} has more than one line", path), "allowed: one line of text"};
  return Value{node.text, node.place};
}

/// Finding what is near an unknown name is costly; hostile files ask for it thousands of times.
Result<Value, Problem> read_zone(const Node& node, const std::string& path, ReadContext& context) {
  const auto text = read_text(node, path);
  if (!text) return text.error();
  if (context.known_zones.contains(node.text)) return Value{node.text, node.place};
  if (node.text.size() > kLongestZone || context.errors.full())
    return Problem{fmt::format("{}: unknown time zone \"{}\"", path, shown(node.text)),
                   "allowed: an IANA name (Europe/Prague), UTC, or an offset (+02:00)"};
  const auto zone = astro::Zone::find(node.text);
  if (!zone) return Problem{fmt::format("{}: {}", path, zone.error().message), zone.error().hint};
  context.known_zones.insert(node.text);
  return Value{node.text, node.place};
}

/// Sides of the image, from "1920x1080", "1920 x 1080" or "512".
Result<Value, Problem> read_size(const Node& node, const std::string& path) {
  const std::string text = plain_text(node.text);
  const size_t cross = text.find_first_of("xX");
  const auto width = parse_integer(text.substr(0, cross));
  const auto height = cross == std::string::npos ? Result<long, Problem>(0L)
                                                 : parse_integer(text.substr(cross + 1));
  if (!width || !height)
    return Problem{fmt::format("{} = {} is no image size", path, shown(text)),
                   "write width x height in pixels, such as 1920x1080; for a cube one number"};
  const bool one_number = cross == std::string::npos;
  if (*width < 1 || *width > kLongestSide || *height > kLongestSide || (!one_number && *height < 1))
    return Problem{fmt::format("{} = {} is out of range", path, shown(text)),
                   fmt::format("allowed: 1 to {} pixels a side", kLongestSide)};
  return Value{PixelSize{int(*width), int(*height)}, node.place};
}

Result<Value, Problem> read_azimuth(const Node& node, const KeySpec& key, const std::string& path) {
  if (const auto compass = value_of(kCompassWords, node.text))
    return Value{(*compass * deg).in(rad), node.place};
  const bool is_word =
      !node.text.empty() && std::isalpha(static_cast<unsigned char>(node.text[0])) != 0;
  if (!is_word) return read_quantity(node, key, path);
  const std::vector<std::string> words = compass_words();
  return Problem{fmt::format("{} = {} is not a direction", path, shown(node.text)),
                 fmt::format("allowed: an angle, or one of {}{}", fmt::join(words, ", "),
                             slip(node.text, words))};
}

Result<Value, Problem> read_view(const Node& node, const std::string& path) {
  const std::vector<std::string> words = view_words();
  if (std::find(words.begin(), words.end(), node.text) != words.end())
    return Value{node.text, node.place};
  return Problem{fmt::format("{} = {} is not a direction", path, shown(node.text)),
                 fmt::format("allowed: {}, or {{azimuth: 270 deg, elevation: 15 deg}}{}",
                             fmt::join(words, ", "), slip(node.text, words))};
}

Result<Value, Problem> read_albedo(const Node& node, const KeySpec& key, const std::string& path) {
  const bool is_word =
      !node.text.empty() && std::isalpha(static_cast<unsigned char>(node.text[0])) != 0;
  if (!is_word) {
    const auto number = read_number(node, key, path);
    if (!number) return number.error();
    return Value{Albedo{node.text, std::get<double>(number->data), false}, node.place};
  }
  if (const auto ground = sky::albedo_bands(node.text))
    return Value{Albedo{node.text, ground->mean, true}, node.place};
  return Problem{
      fmt::format("{} = {} is not known", path, shown(node.text)),
      fmt::format("allowed: 0 to 1, or one of {}{}", fmt::join(sky::ground_albedo_names(), ", "),
                  slip(node.text, sky::ground_albedo_names()))};
}

Result<Value, Problem> read_file(const Node& node, const std::string& path,
                                 const ReadContext& context) {
  if (node.text.empty() || node.text.size() > 1000)
    return Problem{fmt::format("{} is no file name", path)};
  namespace fs = std::filesystem;
  const fs::path file = fs::path(context.folder) / node.text;  // an absolute name stays as it is
  return Value{file.lexically_normal().string(), node.place};
}

Result<Value, Problem> read_output_path(const Node& node, const std::string& path) {
  if (auto problem = path_template_problem(node.text)) {
    problem->message = fmt::format("{}: {}", path, problem->message);
    return *problem;
  }
  return Value{node.text, node.place};
}

Result<Value, Problem> read_time(const Node& node, const std::string& path) {
  auto time = parse_time_expression(node.text);
  if (!time) return Problem{fmt::format("{}: {}", path, time.error().message), time.error().hint};
  return Value{std::move(*time), node.place};
}

Result<Value, Problem> read_date(const Node& node, const std::string& path, bool range) {
  auto dates = range ? parse_date_range(node.text) : Result<DateRange, Problem>(DateRange{});
  if (!range) {
    const auto date = parse_date(node.text);
    if (date)
      dates = DateRange{*date, *date, 1, {}};
    else
      dates = date.error();
  }
  if (!dates)
    return Problem{fmt::format("{}: {}", path, dates.error().message), dates.error().hint};
  return Value{*dates, node.place};
}

}  // namespace

std::string allowed_values(const KeySpec& key) {
  if (!key.words.empty()) return fmt::format("{}", fmt::join(key.words, ", "));
  if (key.kind == ValueKind::on_off) return "on, off";
  if (!key.min.empty()) return fmt::format("{} to {}", key.min, key.max);
  return {};
}

std::vector<std::string> compass_words() { return strings(words_of(kCompassWords)); }

std::vector<std::string> view_words() {
  std::vector<std::string> words = compass_words();
  words.insert(words.end(), {"zenith", "nadir"});
  return words;
}

Result<Value, Problem> read_scalar(const Node& node, const KeySpec& key, const std::string& path,
                                   ReadContext& context) {
  switch (key.kind) {
    case ValueKind::number:
      return read_number(node, key, path);
    case ValueKind::integer:
      return read_integer(node, key, path);
    case ValueKind::quantity:
      return read_quantity(node, key, path);
    case ValueKind::on_off:
      return read_on_off(node, path);
    case ValueKind::word:
      return read_word(node, key, path);
    case ValueKind::text:
      return read_text(node, path);
    case ValueKind::file:
      return read_file(node, path, context);
    case ValueKind::output_path:
      return read_output_path(node, path);
    case ValueKind::zone:
      return read_zone(node, path, context);
    case ValueKind::date:
      return read_date(node, path, false);
    case ValueKind::dates:
      return read_date(node, path, true);
    case ValueKind::time:
      return read_time(node, path);
    case ValueKind::image_size:
      return read_size(node, path);
    case ValueKind::azimuth:
      return read_azimuth(node, key, path);
    case ValueKind::view_direction:
      return read_view(node, path);
    case ValueKind::albedo:
      return read_albedo(node, key, path);
    case ValueKind::section:
    case ValueKind::section_list:
      break;
  }
  assert(false);
  return Problem{"this cannot be a single value"};
}

}  // namespace skylapse::config
