#pragma once
// Small helpers to read and write ISO 8601 text; shared by instants, zones and zone-file footers.
#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace skylapse::astro {

/// Reads a text from left to right. Every take_... either consumes what it names or nothing.
class TextScanner {
 public:
  explicit TextScanner(std::string_view text) : rest_(text) {}
  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  [[nodiscard]] bool at_digit() const {
    return !rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9';
  }
  [[nodiscard]] char peek() const { return rest_.empty() ? '\0' : rest_.front(); }
  bool take(char c);
  char take_any();
  /// The digit at the front; asserts at_digit().
  int take_digit();
  /// A number of `min_digits` to `max_digits` digits (at most 9).
  std::optional<int> take_number(int min_digits, int max_digits);
  /// "Z", "+02:00", "-0330", "+2" or "+02:00:30"; east positive; below 24 hours.
  std::optional<std::chrono::seconds> take_utc_offset();

 private:
  std::string_view rest_;
};

/// Nearest multiple of 10^-decimals seconds; halves go to the later one. Domain: decimals 0..6.
template <class Clock>
std::chrono::time_point<Clock, std::chrono::microseconds> round_to_decimals(
    std::chrono::time_point<Clock, std::chrono::microseconds> t, int decimals) {
  std::chrono::microseconds unit = std::chrono::seconds{1};
  for (int i = 0; i < decimals; ++i) unit /= 10;
  const auto shifted = t + unit / 2;
  const auto above = shifted.time_since_epoch() % unit;  // negative before 1970
  return shifted - (above < above.zero() ? above + unit : above);
}

/// "2026-06-21T04:30:00.250" of a time since 1970-01-01. With `leap_second`, the first second of a
/// minute is shown as second 60 of the minute before. Digits beyond `decimals` are dropped.
std::string format_clock(std::chrono::microseconds since_1970, bool leap_second, int decimals);

/// "+02:00", "-03:30", with seconds only if there are any.
std::string format_offset(std::chrono::seconds offset);

}  // namespace skylapse::astro
