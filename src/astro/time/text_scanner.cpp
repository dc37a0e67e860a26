#include "astro/time/text_scanner.h"

#include <fmt/format.h>

#include <cassert>

namespace skylapse::astro {

using std::chrono::seconds;

bool TextScanner::take(char c) {
  if (rest_.empty() || rest_.front() != c) return false;
  rest_.remove_prefix(1);
  return true;
}

char TextScanner::take_any() {
  assert(!rest_.empty());
  const char c = rest_.front();
  rest_.remove_prefix(1);
  return c;
}

int TextScanner::take_digit() {
  assert(at_digit());
  return take_any() - '0';
}

std::optional<int> TextScanner::take_number(int min_digits, int max_digits) {
  const std::string_view before = rest_;
  int value = 0;
  int digits = 0;
  for (; digits < max_digits && at_digit(); ++digits) value = 10 * value + take_digit();
  if (digits >= min_digits) return value;
  rest_ = before;
  return std::nullopt;
}

std::optional<seconds> TextScanner::take_utc_offset() {
  const std::string_view before = rest_;
  if (take('Z') || take('z')) return seconds{0};
  const int sign = peek() == '-' ? -1 : 1;
  if (take('+') || take('-')) {
    const auto hours = take_number(1, 2);
    std::optional<int> minutes = 0;
    std::optional<int> secs = 0;
    if (take(':')) {
      minutes = take_number(2, 2);
      if (minutes && take(':')) secs = take_number(2, 2);
    } else if (at_digit()) {
      minutes = take_number(2, 2);
    }
    if (hours && minutes && secs && *hours < 24 && *minutes < 60 && *secs < 60)
      return seconds{sign * (3600 * *hours + 60 * *minutes + *secs)};
  }
  rest_ = before;
  return std::nullopt;
}

std::string format_clock(std::chrono::microseconds since_1970, bool leap_second, int decimals) {
  using std::chrono::days;
  std::chrono::sys_time<std::chrono::microseconds> t{since_1970};
  if (leap_second) t -= seconds{1};
  const auto day = std::chrono::floor<days>(t);
  const std::chrono::year_month_day date{day};
  const auto whole = std::chrono::floor<seconds>(t - day);
  const int s = static_cast<int>(whole.count());
  std::string text =
      fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", int{date.year()}, unsigned{date.month()},
                  unsigned{date.day()}, s / 3600, s / 60 % 60, s % 60 + (leap_second ? 1 : 0));
  if (decimals > 0)
    text += fmt::format(".{:06}", (t - day - whole).count())
                .substr(0, 1 + static_cast<size_t>(decimals));
  return text;
}

std::string format_offset(seconds offset) {
  const auto magnitude = std::chrono::abs(offset).count();
  std::string text = fmt::format("{}{:02}:{:02}", offset < seconds{0} ? '-' : '+', magnitude / 3600,
                                 magnitude / 60 % 60);
  if (magnitude % 60 != 0) text += fmt::format(":{:02}", magnitude % 60);
  return text;
}

}  // namespace skylapse::astro
