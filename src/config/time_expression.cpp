#include "config/time_expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "config/quantity_parser.h"
#include "core/printable.h"

namespace skylapse::config {
namespace {

using std::chrono::microseconds;
using std::chrono::seconds;

constexpr int kFirstYear = 1900, kLastYear = 2199;  // the range of astro::parse_instant

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Reads a text from the front; every take_ function moves on only when it succeeds.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : text_(text) {}
  [[nodiscard]] bool at_end() const { return at_ == text_.size(); }
  [[nodiscard]] char peek(size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  [[nodiscard]] std::string rest() const { return std::string(text_.substr(at_)); }
  bool take(char c) { return peek() == c && (++at_, true); }
  bool take_word(std::string_view word) {
    if (!text_.substr(at_).starts_with(word)) return false;
    at_ += word.size();
    return true;
  }
  void skip_blanks() {
    while (peek() == ' ' || peek() == '\t') ++at_;
  }
  /// `least` to `most` digits.
  std::optional<int> digits(size_t least, size_t most) {
    size_t n = 0;
    int value = 0;
    while (n < most && is_digit(peek(n))) value = value * 10 + (peek(n++) - '0');
    if (n < least || is_digit(peek(n))) return std::nullopt;
    at_ += n;
    return value;
  }
  std::string name() {
    const size_t begin = at_;
    const auto in_name = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || is_digit(c);
    };
    while (in_name(peek())) ++at_;
    return std::string(text_.substr(begin, at_ - begin));
  }
  [[nodiscard]] size_t position() const { return at_; }
  void back_to(size_t position) { at_ = position; }

 private:
  std::string_view text_;
  size_t at_ = 0;
};

Result<std::chrono::year_month_day, Problem> take_date(Cursor& text, std::string_view whole) {
  const Problem malformed{fmt::format("\"{}\" is not a date", shown(whole)),
                          "dates are written year-month-day, such as 2026-06-21"};
  const auto year = text.digits(4, 4);
  if (!year || !text.take('-')) return malformed;
  const auto month = text.digits(1, 2);
  if (!month || !text.take('-')) return malformed;
  const auto day = text.digits(1, 2);
  if (!day) return malformed;
  const std::chrono::year_month_day date{std::chrono::year(*year),
                                         std::chrono::month(unsigned(*month)),
                                         std::chrono::day(unsigned(*day))};
  if (*month < 1 || *month > 12)
    return Problem{fmt::format("there is no month {} in \"{}\"", *month, shown(whole)),
                   "dates are written year-month-day"};
  if (!date.ok()) {
    const auto last =
        std::chrono::year_month_day_last{date.year(), std::chrono::month_day_last{date.month()}};
    return Problem{fmt::format("{:04}-{:02} has no day {}", *year, *month, *day),
                   fmt::format("its last day is {}", unsigned(last.day()))};
  }
  if (*year < kFirstYear || *year > kLastYear)
    return Problem{fmt::format("the year {} is out of range", *year),
                   fmt::format("allowed: {} to {}", kFirstYear, kLastYear)};
  return date;
}

bool looks_like_date(const Cursor& text) {
  return is_digit(text.peek(0)) && is_digit(text.peek(1)) && is_digit(text.peek(2)) &&
         is_digit(text.peek(3)) && text.peek(4) == '-';
}

/// The fraction of a second after the point, to the microsecond.
microseconds take_fraction(Cursor& text) {
  long value = 0, unit = 1'000'000;
  while (is_digit(text.peek())) {
    unit /= 10;
    value += unit * (text.peek() - '0');
    text.take(text.peek());
  }
  return microseconds(value);
}

std::optional<Problem> take_clock(Cursor& text, TimeExpression& time) {
  const std::string whole = text.rest();
  const Problem malformed{fmt::format("\"{}\" is not a time of day", shown(whole)),
                          "times are written hh:mm or hh:mm:ss, such as 04:30"};
  const auto hour = text.digits(1, 2);
  if (!hour || !text.take(':')) return malformed;
  const auto minute = text.digits(2, 2);
  if (!minute) return malformed;
  int second = 0;
  microseconds fraction{0};
  if (text.take(':')) {
    const auto digits = text.digits(2, 2);
    if (!digits) return malformed;
    second = *digits;
    if (text.take('.')) fraction = take_fraction(text);
  }
  const bool end_of_day = *hour == 24 && *minute == 0 && second == 0 && fraction.count() == 0;
  if ((*hour > 23 && !end_of_day) || *minute > 59 || second > 60)
    return Problem{fmt::format("there is no time of day {:02}:{:02}:{:02}", *hour, *minute, second),
                   "allowed: 00:00 to 24:00"};
  time.leap_second = second == 60;
  time.clock =
      std::chrono::hours(*hour) + std::chrono::minutes(*minute) + seconds(second) + fraction;
  return std::nullopt;
}

/// "Z", "UTC", "+02:00", "-0330", "+2" directly after a clock. A sign may also begin a duration:
/// that has a unit, an offset has none.
std::optional<Problem> take_utc_offset(Cursor& text, TimeExpression& time) {
  const size_t begin = text.position();
  text.skip_blanks();
  if (text.take_word("UTC") || text.take_word("Z")) {
    time.utc_offset = seconds(0);
    return std::nullopt;
  }
  const char sign = text.peek();
  if (sign != '+' && sign != '-') {
    text.back_to(begin);
    return std::nullopt;
  }
  text.take(sign);
  const auto give_back = [&] { text.back_to(begin); };
  int hours = 0, minutes = 0;
  bool has_colon = false;
  if (const auto four = text.digits(4, 4)) {
    hours = *four / 100, minutes = *four % 100;
  } else if (const auto one_or_two = text.digits(1, 2)) {
    hours = *one_or_two;
    has_colon = text.take(':');
    const auto two = has_colon ? text.digits(2, 2) : 0;
    if (!two) return Problem{"the offset from UTC is incomplete", "write it as +02:00"};
    minutes = *two;
  } else {
    return give_back(), std::nullopt;
  }
  const size_t end = text.position();
  text.skip_blanks();
  const bool has_unit = !text.at_end() && text.peek() != '+' && text.peek() != '-';
  if (!has_colon && has_unit) return give_back(), std::nullopt;
  text.back_to(end);
  if (hours > 18 || minutes > 59)
    return Problem{fmt::format("there is no offset of {} h {} min from UTC", hours, minutes),
                   "allowed: -18:00 to +18:00"};
  time.utc_offset = seconds((sign == '-' ? -1 : 1) * (hours * 3600 + minutes * 60));
  return std::nullopt;
}

/// Words that people try first, and what is meant.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kOtherWords{{
    {"noon", "solar_noon, or 12:00 by the clock"},
    {"midnight", "solar_midnight, or 00:00 by the clock"},
    {"dawn", "civil_dawn, nautical_dawn or astro_dawn"},
    {"dusk", "civil_dusk, nautical_dusk or astro_dusk"},
    {"astronomical_dawn", "astro_dawn"},
    {"astronomical_dusk", "astro_dusk"},
}};

Problem unknown_anchor(const std::string& word) {
  for (const auto& [other, meant] : kOtherWords)
    if (word == other)
      return {fmt::format("\"{}\" is not a time", word), fmt::format("write {}", meant)};
  const std::vector<std::string> names = anchor_names();
  const auto nearest = word.size() <= 40 ? nearest_name(word, names) : std::nullopt;
  return {fmt::format("\"{}\" is not a time", shown(word)),
          nearest
              ? fmt::format("did you mean {}?", *nearest)
              : fmt::format("allowed: a clock time such as 04:30, or {}", fmt::join(names, ", "))};
}

std::optional<Problem> take_anchor(Cursor& text, TimeExpression& time) {
  const std::string whole = text.rest();
  const std::string word = text.name();
  time.anchor = astro::event_kind_from_name(word);
  if (!time.anchor) return unknown_anchor(word.empty() ? whole : word);
  return std::nullopt;
}

std::optional<Problem> take_shift(Cursor& text, TimeExpression& time) {
  text.skip_blanks();
  if (text.at_end()) return std::nullopt;
  const char sign = text.peek();
  if (sign != '+' && sign != '-')
    return Problem{fmt::format("\"{}\" follows the time", shown(text.rest())),
                   "add or take away a duration by + or -, such as sunrise - 45 min"};
  text.take(sign);
  text.skip_blanks();
  if (text.peek() == '+' || text.peek() == '-')
    return Problem{fmt::format("\"{}\" has two signs", shown(text.rest())), "use one of them"};
  const auto duration = parse_quantity(text.rest(), Dimension::duration);
  if (!duration) return duration.error();
  if (*duration > 400 * 86400.0)
    return Problem{fmt::format("{} is too long", shown(text.rest())), "allowed: at most 400 days"};
  time.offset = (sign == '-' ? -1.0 : 1.0) * *duration * second;
  return std::nullopt;
}

/// A leap second can be looked up only where day and offset are written with it.
std::optional<Problem> check_leap_second(const TimeExpression& time) {
  if (!time.leap_second || !time.date || !time.utc_offset) return std::nullopt;
  const long written = (*time.clock / seconds(1)) - 1;  // the second before, then ":60"
  const long offset = time.utc_offset->count();
  const auto found = astro::parse_instant(fmt::format(
      "{}T{:02}:{:02}:60{}{:02}:{:02}", date_text(*time.date), written / 3600, written / 60 % 60,
      offset < 0 ? '-' : '+', std::abs(offset) / 3600, std::abs(offset) / 60 % 60));
  if (found) return std::nullopt;
  return Problem{found.error().message, found.error().hint};
}

}  // namespace

Result<std::chrono::year_month_day, Problem> parse_date(std::string_view text) {
  const std::string plain = plain_text(text);
  Cursor cursor(plain);
  auto date = take_date(cursor, plain);
  if (date && !cursor.at_end())
    return Problem{fmt::format("\"{}\" is not a date", shown(plain)),
                   "dates are written year-month-day, such as 2026-06-21"};
  return date;
}

Result<DateRange, Problem> parse_date_range(std::string_view text) {
  const size_t dots = text.find("..");
  const auto first = parse_date(text.substr(0, dots));
  if (!first) return first.error();
  if (dots == std::string_view::npos) return DateRange{*first, *first, 1, {}};
  const auto last = parse_date(text.substr(dots + 2));
  if (!last) return last.error();
  if (*last < *first)
    return Problem{"the range ends before it begins", "write the earlier day first"};
  return DateRange{*first, *last, 1, {}};
}

Result<TimeExpression, Problem> parse_time_expression(std::string_view text) {
  const std::string plain = plain_text(text);
  Cursor cursor(plain);
  TimeExpression time;
  if (looks_like_date(cursor)) {
    const auto date = take_date(cursor, plain.substr(0, plain.find_first_of(" T")));
    if (!date) return date.error();
    time.date = *date;
    if (!cursor.take('T')) cursor.skip_blanks();
    if (cursor.at_end())
      return Problem{fmt::format("\"{}\" has no time of day", plain),
                     fmt::format("add one: {} 00:00, or {} sunrise", plain, plain)};
  }
  if (is_digit(cursor.peek())) {
    if (auto problem = take_clock(cursor, time)) return *problem;
    if (auto problem = take_utc_offset(cursor, time)) return *problem;
  } else if (auto problem = take_anchor(cursor, time)) {
    return *problem;
  }
  if (auto problem = take_shift(cursor, time)) return *problem;
  if (auto problem = check_leap_second(time)) return *problem;
  return time;
}

std::string date_text(std::chrono::year_month_day date) {
  return fmt::format("{:04}-{:02}-{:02}", int(date.year()), unsigned(date.month()),
                     unsigned(date.day()));
}

std::vector<std::string> anchor_names() {
  std::vector<std::string> names;
  for (int kind = 0; kind < astro::kEventKindCount; ++kind)
    names.push_back(astro::name_of(static_cast<astro::EventKind>(kind)));
  return names;
}

}  // namespace skylapse::config
