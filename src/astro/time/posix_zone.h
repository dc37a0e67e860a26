#pragma once
// The rule at the end of a time-zone file: summer time after the file's last transition.
#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace skylapse::astro {

/// A stretch of time with one offset from UTC: [begin, end).
struct ZonePeriod {
  std::chrono::sys_seconds begin;
  std::chrono::sys_seconds end;
  std::chrono::seconds utc_offset{};  // east positive
  std::string abbreviation;
};

/// Ends of periods that have no transition: years 1 and 9999.
inline constexpr std::chrono::sys_seconds kFarPast =
    std::chrono::sys_days{std::chrono::year{1} / 1 / 1};
inline constexpr std::chrono::sys_seconds kFarFuture =
    std::chrono::sys_days{std::chrono::year{9999} / 1 / 1};

/// A POSIX TZ string, as the footer of TZif files holds it: "CET-1CEST,M3.5.0,M10.5.0/3".
/// Source  IEEE Std 1003.1-2017, section 8.3, with the extensions of RFC 8536, 3.3.1 (hours
///         -167..167; all-year daylight saving).
class PosixZone {
 public:
  /// Nothing if the text is not such a string.
  static std::optional<PosixZone> parse(std::string_view text);
  [[nodiscard]] ZonePeriod period_at(std::chrono::sys_seconds t) const;

 private:
  enum class DayRule { month_week_day, julian_without_leap_day, zero_based_day };
  struct Switch {
    DayRule rule = DayRule::month_week_day;
    int month = 1, week = 1, weekday = 0;  // of month_week_day; week 5 is the last
    int day = 0;                           // of the other two
    std::chrono::seconds local_time{};     // on the clock in force before the switch
    [[nodiscard]] std::chrono::local_seconds in_year(std::chrono::year y) const;
  };
  struct Summer {
    std::string name;
    std::chrono::seconds utc_offset{};
    Switch begin, end;
  };
  static std::optional<Switch> take_switch(class TextScanner& in);

  std::string name_;
  std::chrono::seconds utc_offset_{};
  std::optional<Summer> summer_;
};

}  // namespace skylapse::astro
