#include "config/quantity_parser.h"

#include <fmt/format.h>

#include <cassert>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/printable.h"

namespace skylapse::config {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

struct Scanned {
  double value;
  std::string_view rest;
};

/// The number at the front of `text`. Signs are part of it; names such as "nan" are not numbers.
Result<Scanned, Problem> scan_number(std::string_view text) {
  std::string_view digits = text;
  const bool negative = !digits.empty() && digits.front() == '-';
  if (negative || (!digits.empty() && digits.front() == '+')) digits = trimmed(digits.substr(1));
  const bool starts_well =
      !digits.empty() &&
      (is_digit(digits.front()) || (digits.size() > 1 && digits[0] == '.' && is_digit(digits[1])));
  if (!starts_well) return Problem{fmt::format("\"{}\" does not begin with a number", shown(text))};
  double value = 0;
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (status == std::errc::result_out_of_range)
    return Problem{fmt::format("the number {} is beyond what can be represented", shown(text))};
  std::string_view rest = digits.substr(size_t(end - digits.data()));
  if (rest.size() > 1 && rest[0] == ',' && is_digit(rest[1]))
    return Problem{fmt::format("\"{}\" holds a comma", shown(text)),
                   "decimals are written with a point"};
  return Scanned{negative ? -value : value, rest};
}

/// A unit ends before a blank, a digit or a sign.
size_t unit_length(std::string_view text) {
  size_t n = 0;
  while (n < text.size() && !is_blank(text[n]) && !is_digit(text[n]) && text[n] != '+' &&
         text[n] != '-' && text[n] != '.')
    ++n;
  return n;
}

const UnitName* find_unit(Dimension dimension, std::string_view symbol) {
  for (const UnitName& unit : info_of(dimension).units)
    if (unit.symbol == symbol) return &unit;
  return nullptr;
}

Problem unknown_unit(std::string_view symbol, Dimension dimension, const std::string& number) {
  const DimensionInfo& wanted = info_of(dimension);
  const std::string hint = fmt::format("allowed units: {}", unit_list(dimension));
  const Dimension other = dimension_of_unit(symbol);
  if (other != Dimension::none)
    return {fmt::format("{} {} is {}, and this is {}", number, symbol, info_of(other).name,
                        wanted.name),
            hint};
  std::vector<std::string> names;
  for (const UnitName& unit : wanted.units) names.emplace_back(unit.symbol);
  const auto nearest =
      symbol.size() <= 24 ? nearest_name(std::string(symbol), names) : std::nullopt;
  return {fmt::format("the unit \"{}\" is not known", shown(symbol)),
          nearest ? fmt::format("{}; did you mean {} {}?", hint, number, *nearest) : hint};
}

Problem missing_unit(const std::string& number, Dimension dimension) {
  return {fmt::format("{} has no unit", number),
          fmt::format("write {} {}; allowed units: {}", number, info_of(dimension).units[0].symbol,
                      unit_list(dimension))};
}

/// Splits a hemisphere letter off a latitude or longitude: +1 for N and E, -1 for S and W.
Result<std::optional<int>, Problem> take_hemisphere(std::string_view& text, Dimension dimension) {
  const std::string_view letters = "NSEW";
  const bool last = !text.empty() && letters.find(text.back()) != std::string_view::npos;
  const bool first = !text.empty() && letters.find(text.front()) != std::string_view::npos;
  if (!last && !first) return std::optional<int>{};
  const char letter = last ? text.back() : text.front();
  const bool north_south = letter == 'N' || letter == 'S';
  if (north_south != (dimension == Dimension::latitude))
    return Problem{
        fmt::format("{} cannot be {}",
                    letter == 'N'   ? "north"
                    : letter == 'S' ? "south"
                    : letter == 'E' ? "east"
                                    : "west",
                    info_of(dimension).name),
        dimension == Dimension::latitude ? "latitudes take N or S" : "longitudes take E or W"};
  last ? text.remove_suffix(1) : text.remove_prefix(1);
  text = trimmed(text);
  if (!text.empty() && (text.front() == '-' || text.front() == '+'))
    return Problem{"the value has both a sign and a letter for the hemisphere", "use one of them"};
  return std::optional<int>{letter == 'N' || letter == 'E' ? 1 : -1};
}

struct Term {
  double base;  // in base units, without the sign
  const UnitName* unit;
};

/// One "number unit" at the front of `text`, which moves on. The unit may be missing only where
/// the dimension has one for plain numbers and nothing follows.
Result<Term, Problem> take_term(std::string_view& text, Dimension dimension) {
  const auto number = scan_number(text);
  if (!number) return number.error();
  const std::string written(trimmed(text.substr(0, text.size() - number->rest.size())));
  std::string_view rest = trimmed(number->rest);
  const size_t length = unit_length(rest);
  const DimensionInfo& info = info_of(dimension);
  if (length == 0) {
    if (info.bare_unit.empty() || !rest.empty()) return missing_unit(written, dimension);
    text = {};
    const UnitName* unit = find_unit(dimension, info.bare_unit);
    return Term{number->value * unit->factor + unit->offset, unit};
  }
  const std::string_view symbol = rest.substr(0, length);
  const UnitName* unit = find_unit(dimension, symbol);
  if (unit == nullptr) return unknown_unit(symbol, dimension, written);
  text = trimmed(rest.substr(length));
  return Term{number->value * unit->factor + unit->offset, unit};
}

}  // namespace

std::string plain_text(std::string_view text) {
  std::string plain;
  for (size_t i = 0; i < text.size();) {
    const std::string_view rest = text.substr(i);
    if (rest.starts_with("\u00A0"))
      plain += ' ', i += 2;
    else if (rest.starts_with("\u2009") || rest.starts_with("\u202F"))
      plain += ' ', i += 3;
    else if (rest.starts_with("\u2212"))
      plain += '-', i += 3;
    else
      plain += text[i++];
  }
  return std::string(trimmed(plain));
}

Result<double, Problem> parse_number(std::string_view text) {
  const std::string plain = plain_text(text);
  const auto number = scan_number(plain);
  if (!number)
    return Problem{number.error().message + ", and this is a number", number.error().hint};
  if (!trimmed(number->rest).empty())
    return Problem{fmt::format("\"{}\" is not a plain number", shown(plain)),
                   "this value has no unit"};
  return number->value;
}

Result<long, Problem> parse_integer(std::string_view text) {
  const std::string plain = plain_text(text);
  long value = 0;
  const char* const begin = plain.data() + (plain.starts_with('+') ? 1 : 0);
  const char* const end = plain.data() + plain.size();
  const auto [stop, status] = std::from_chars(begin, end, value);
  if (status == std::errc::result_out_of_range)
    return Problem{fmt::format("the number {} is too large", shown(plain))};
  if (status != std::errc{} || stop != end)
    return Problem{fmt::format("\"{}\" is not a whole number", shown(plain))};
  return value;
}

Result<double, Problem> parse_quantity(std::string_view text, Dimension dimension) {
  const std::string plain = plain_text(text);
  const DimensionInfo& info = info_of(dimension);
  assert(!info.units.empty());
  std::string_view rest = plain;
  std::optional<int> hemisphere;
  if (dimension == Dimension::latitude || dimension == Dimension::longitude) {
    const auto taken = take_hemisphere(rest, dimension);
    if (!taken) return taken.error();
    hemisphere = *taken;
  }
  const bool negative = !rest.empty() && rest.front() == '-';
  auto term = take_term(rest, dimension);
  if (!term) return Problem{term.error().message, term.error().hint};
  double sum = std::abs(term->base);
  if (!info.compound || rest.empty()) sum = term->base;
  const bool is_sum = info.compound && !rest.empty();
  while (is_sum && !rest.empty()) {
    const UnitName* const larger = term->unit;
    if (rest.front() == '-' || rest.front() == '+')
      return Problem{fmt::format("\"{}\" is followed by \"{}\"",
                                 shown(plain.substr(0, plain.size() - rest.size())), shown(rest))};
    term = take_term(rest, dimension);
    if (!term) return term.error();
    if (term->unit->factor >= larger->factor)
      return Problem{fmt::format("\"{}\" does not go from larger to smaller units", shown(plain))};
    if (term->base >= larger->factor)
      return Problem{
          fmt::format("the part in {} reaches a whole {}", term->unit->symbol, larger->symbol),
          "carry it over to the larger unit"};
    sum += term->base;
  }
  if (!rest.empty())
    return Problem{fmt::format("\"{}\" follows the value", shown(rest)),
                   fmt::format("this is {}: one number and its unit", info.name)};
  if (is_sum && negative) sum = -sum;
  if (!std::isfinite(sum))
    return Problem{fmt::format("the number {} is beyond what can be represented", shown(plain))};
  return hemisphere ? *hemisphere * sum : sum;
}

}  // namespace skylapse::config
