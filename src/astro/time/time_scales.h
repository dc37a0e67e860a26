#pragma once
// From civil time to the two clocks that astronomy needs: TT drives the bodies, UT1 turns the
// Earth.
#include <optional>

#include "astro/time/instant.h"

namespace skylapse::astro {

/// TT - UTC. Domain: any instant.
///   from 1972   leap seconds so far (ERFA's table; after its last entry no more are assumed) plus
///               32.184 s; inside a leap second the count is still the old one;
///   before      the stamp is read as UT1 and delta_t() stands in.
Duration tt_minus_utc(const Instant& instant);

/// TT - UT1 before leap seconds, from the calendar date.
/// Source  Espenak & Meeus 2006, "Five Millennium Canon of Solar Eclipses", polynomials of
///         1860..1986; fitted to observation, within 0.2 s of the tabulated values.
/// Domain  years 1860 to 1986; before 1860 the value of 1860 is held (the parser starts at 1900).
Duration delta_t(const Instant& instant);

/// True if a leap second ends the UTC day that begins at `day`.
bool day_ends_with_leap_second(std::chrono::sys_days day);

/// One instant on both clocks, as days from J2000.0 (2000-01-01 12:00 of each scale).
/// UT1 comes in two parts, so that the Earth's rotation keeps its microseconds.
struct AstronomicalTime {
  double tt_days = 0;
  double ut1_whole_days = 0;
  double ut1_day_fraction = 0;  // in [0, 1) plus the small dut1
};

/// `dut1` = UT1 - UTC, used from 1972 on (before, the stamp is UT1 itself);
/// `tt_minus_ut1`, if given, replaces leap seconds and delta_t.
AstronomicalTime astronomical_time(const Instant& instant, Duration dut1,
                                   std::optional<Duration> tt_minus_ut1);

}  // namespace skylapse::astro
