#pragma once
#include <chrono>
#include <compare>
#include <string>
#include <string_view>

#include "core/quantity.h"
#include "core/result.h"

namespace skylapse::astro {

/// A moment of UTC. Outside leap seconds `utc` is the civil time scale itself (86,400 s a day).
/// Inside the leap second 23:59:60 `leap_second` is set and `utc` holds the following 00:00:00
/// plus the fraction, so that UT1 = UTC makes both the same sidereal time, and TT differs by 1 s.
struct Instant {
  std::chrono::sys_time<std::chrono::microseconds> utc{};
  bool leap_second = false;
  friend bool operator==(const Instant&, const Instant&) = default;
  /// 23:59:60.x comes before the following 00:00:00.
  friend std::strong_ordering operator<=>(const Instant& a, const Instant& b);
};

/// Moves by civil time (leap seconds are not counted).
Instant operator+(const Instant& instant, Duration elapsed);
Duration operator-(const Instant& later, const Instant& earlier);

/// ISO 8601 with "Z" or a numeric offset: 2026-06-21T04:30Z, 2016-12-31T23:59:60Z,
/// 2026-06-21 04:30:15.25+02:00. A time without either is an error, and so is a ":60" that is no
/// leap second, 29 February of a common year, or a year outside 1900..2199.
Result<Instant> parse_instant(std::string_view text);

/// 2026-06-21T04:30:00Z with `decimals` digits of the second (rounded; 0..6).
std::string format_utc(const Instant& instant, int decimals = 0);

}  // namespace skylapse::astro
