#pragma once
#include <chrono>
#include <memory>
#include <string>

#include "astro/time/instant.h"

namespace skylapse::astro {

using WallTime = std::chrono::local_time<std::chrono::microseconds>;

/// A reading of a wall clock: the local time, its offset from UTC (east positive), and the
/// abbreviation in force ("CEST").
struct LocalTime {
  WallTime wall{};
  std::chrono::seconds utc_offset{};
  std::string abbreviation;
  bool leap_second = false;  // as in Instant: `wall` then holds the second that follows
};

/// A local calendar day as the half-open interval of UTC between two local midnights.
struct CivilDay {
  std::chrono::year_month_day date;
  Instant start;
  Instant end;
};

/// A time zone: an IANA zone ("Europe/Prague"), "UTC", "Z", or a fixed offset ("+02:00", "-7").
/// Rules continue after the last transition of the zone file by the file's own footer.
class Zone {
 public:
  /// Unknown names are errors that carry the nearest known name.
  static Result<Zone> find(const std::string& name);
  [[nodiscard]] const std::string& name() const;
  [[nodiscard]] LocalTime to_local(const Instant& instant) const;
  /// A local time that is skipped or repeated is an error that names both offsets.
  [[nodiscard]] Result<Instant> to_instant(WallTime wall) const;
  /// A day that the zone skips altogether (Pacific/Apia 2011-12-30) is an error that says so.
  /// When midnight itself is skipped or repeated the day starts at its first instant.
  [[nodiscard]] Result<CivilDay> civil_day(std::chrono::year_month_day date) const;

 private:
  struct Rules;
  explicit Zone(std::shared_ptr<const Rules> rules);
  std::shared_ptr<const Rules> rules_;
};

/// "2026-06-21T06:30:00+02:00".
std::string format_local(const LocalTime& local, int decimals = 0);

}  // namespace skylapse::astro
