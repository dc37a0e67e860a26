#include "astro/time/instant.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "astro/time/text_scanner.h"
#include "astro/time/time_scales.h"

namespace skylapse::astro {
namespace {

using std::chrono::days;
using std::chrono::floor;
using std::chrono::microseconds;
using std::chrono::seconds;
using std::chrono::sys_days;
using std::chrono::sys_time;
using std::chrono::year_month_day;

constexpr int kFirstYear = 1900;
constexpr int kLastYear = 2199;

struct ClockReading {
  year_month_day date;
  seconds time_of_day{};  // 23:59:60 counts as 86,400 s
  microseconds fraction{};
  bool says_60 = false;
  seconds offset{};
};

Error invalid(std::string_view text, const std::string& why) {
  return {.code = ErrorCode::invalid_input,
          .message = fmt::format("\"{}\" is not a time: {}", text, why),
          .hint =
              "write ISO 8601 with Z or an offset: 2026-06-21T04:30:00Z, "
              "2026-06-21T06:30+02:00"};
}

/// Digits after the decimal mark, rounded to microseconds.
std::optional<microseconds> scan_fraction(TextScanner& in) {
  double value = 0;
  double unit = 0.1;
  int digits = 0;
  for (; in.at_digit(); ++digits, unit /= 10) value += unit * in.take_digit();
  if (digits == 0) return std::nullopt;
  return microseconds{std::llround(value * 1e6)};
}

/// Fills `reading`; returns what is wrong with the text, or nothing.
std::optional<std::string> scan_reading(TextScanner& in, ClockReading& reading) {
  const auto y = in.take_number(4, 4);
  if (!y || !in.take('-')) return "the date must read YYYY-MM-DD";
  const auto m = in.take_number(2, 2);
  if (!m || !in.take('-')) return "the date must read YYYY-MM-DD";
  const auto d = in.take_number(2, 2);
  if (!d) return "the date must read YYYY-MM-DD";
  reading.date = std::chrono::year{*y} / static_cast<unsigned>(*m) / static_cast<unsigned>(*d);
  if (!reading.date.ok())
    return fmt::format("{:04}-{:02}-{:02} is not a date of the calendar", *y, *m, *d);
  if (*y < kFirstYear || *y > kLastYear)
    return fmt::format("the year must lie in {}..{}", kFirstYear, kLastYear);
  if (!in.take('T') && !in.take('t') && !in.take(' '))
    return "a time of day must follow the date, after T or a space";
  const auto h = in.take_number(2, 2);
  if (!h || !in.take(':')) return "the time of day must read HH:MM or HH:MM:SS";
  const auto min = in.take_number(2, 2);
  if (!min) return "the time of day must read HH:MM or HH:MM:SS";
  int s = 0;
  if (in.take(':')) {
    const auto sec = in.take_number(2, 2);
    if (!sec) return "the seconds must have two digits";
    s = *sec;
    if (in.take('.') || in.take(',')) {
      const auto fraction = scan_fraction(in);
      if (!fraction) return "digits must follow the decimal mark";
      reading.fraction = *fraction;
    }
  }
  if (*h > 23 || *min > 59 || s > 60) return "hours go to 23, minutes to 59, seconds to 59";
  reading.says_60 = s == 60;
  reading.time_of_day = std::chrono::hours{*h} + std::chrono::minutes{*min} + seconds{s};
  return std::nullopt;
}

std::optional<std::string> scan_zone(TextScanner& in, ClockReading& reading) {
  if (in.at_end()) return "it names no zone (Z or an offset such as +02:00)";
  const auto offset = in.take_utc_offset();
  if (!offset) return "Z or an offset such as +02:00 must follow the time of day";
  reading.offset = *offset;
  if (!in.at_end()) return "something follows the zone";
  return std::nullopt;
}

}  // namespace

std::strong_ordering operator<=>(const Instant& a, const Instant& b) {
  const auto key = [](const Instant& i) {
    const auto whole = floor<seconds>(i.utc);
    return std::tuple{whole, !i.leap_second, i.utc - whole};
  };
  return key(a) <=> key(b);
}

Instant operator+(const Instant& instant, Duration elapsed) {
  const microseconds step{std::llround(elapsed.in(second)*1e6)};
  if (step == microseconds{0}) return instant;
  return {.utc = instant.utc + step};
}

Duration operator-(const Instant& later, const Instant& earlier) {
  return static_cast<double>((later.utc - earlier.utc).count()) * 1e-6 * second;
}

Result<Instant> parse_instant(std::string_view text) {
  TextScanner in(text);
  ClockReading reading;
  if (const auto wrong = scan_reading(in, reading)) return invalid(text, *wrong);
  if (const auto wrong = scan_zone(in, reading)) return invalid(text, *wrong);
  const sys_time<microseconds> utc =
      sys_days{reading.date} + reading.time_of_day + reading.fraction - reading.offset;
  if (!reading.says_60) return Instant{.utc = utc};
  const auto second_after = floor<seconds>(utc - reading.fraction);
  const sys_days midnight = floor<days>(second_after);
  if (second_after != midnight || !day_ends_with_leap_second(midnight - days{1}))
    return invalid(text, "there was no leap second at that moment");
  // A fraction that rounds up to 1 ends the leap second.
  const bool inside = reading.fraction < seconds{1};
  return Instant{.utc = inside ? utc : sys_time<microseconds>{midnight}, .leap_second = inside};
}

std::string format_utc(const Instant& instant, int decimals) {
  assert(decimals >= 0 && decimals <= 6);
  Instant shown{.utc = round_to_decimals(instant.utc, decimals),
                .leap_second = instant.leap_second};
  const bool next_second = floor<seconds>(shown.utc) > floor<seconds>(instant.utc);
  if (next_second && instant.leap_second) {
    shown = {.utc = floor<days>(instant.utc)};  // 23:59:60.9999 rounds to 00:00:00
  } else if (next_second && shown.utc == floor<days>(shown.utc)) {
    // 23:59:59.9999 rounds to 23:59:60 where there is one
    shown.leap_second = day_ends_with_leap_second(floor<days>(instant.utc));
  }
  return format_clock(shown.utc.time_since_epoch(), shown.leap_second, decimals) + "Z";
}

}  // namespace skylapse::astro
