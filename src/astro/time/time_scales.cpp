#include "astro/time/time_scales.h"

#include <erfa.h>

#include <cmath>

#include "core/constants.h"

namespace skylapse::astro {
namespace {

using std::chrono::days;
using std::chrono::floor;
using std::chrono::microseconds;
using std::chrono::sys_days;
using std::chrono::year;
using std::chrono::year_month_day;

constexpr sys_days kLeapSecondEra = year{1972} / 1 / 1;
constexpr sys_days kJ2000Day = year{2000} / 1 / 1;
constexpr microseconds kHalfDay = std::chrono::hours{12};
constexpr double kMicrosecondsPerDay = 86400e6;
constexpr double kSecondsPerDay = 86400.0;

double tai_minus_utc_s(sys_days day) {
  const year_month_day date{day};
  double seconds = 0;
  // Status +1 ("dubious year", past the library's horizon) still returns the last known count.
  [[maybe_unused]] const int status =
      eraDat(int{date.year()}, static_cast<int>(unsigned{date.month()}),
             static_cast<int>(unsigned{date.day()}), 0.0, &seconds);
  assert(status >= 0);
  return seconds;
}

/// The UTC day an instant belongs to; a leap second belongs to the day that it ends.
sys_days utc_day(const Instant& instant) {
  const sys_days day = floor<days>(instant.utc);
  return instant.leap_second ? day - days{1} : day;
}

}  // namespace

bool day_ends_with_leap_second(sys_days day) {
  return day >= kLeapSecondEra && tai_minus_utc_s(day + days{1}) > tai_minus_utc_s(day);
}

Duration delta_t(const Instant& instant) {
  const double days_from_2000 = static_cast<double>((instant.utc - kJ2000Day).count()) / 86400e6;
  const double y = std::fmax(1860.0, 2000.0 + days_from_2000 / 365.2425);
  const auto polynomial = [](double t, auto... coefficients) {
    double sum = 0;
    double power = 1;
    ((sum += coefficients * power, power *= t), ...);
    return sum * second;
  };
  if (y < 1900)
    return polynomial(y - 1860, 7.62, 0.5737, -0.251754, 0.01680668, -0.0004473624, 1 / 233174.0);
  if (y < 1920) return polynomial(y - 1900, -2.79, 1.494119, -0.0598939, 0.0061966, -0.000197);
  if (y < 1941) return polynomial(y - 1920, 21.20, 0.84493, -0.076100, 0.0020936);
  if (y < 1961) return polynomial(y - 1950, 29.07, 0.407, -1 / 233.0, 1 / 2547.0);
  return polynomial(y - 1975, 45.45, 1.067, -1 / 260.0, -1 / 718.0);
}

Duration tt_minus_utc(const Instant& instant) {
  const sys_days day = utc_day(instant);
  if (day < kLeapSecondEra) return delta_t(instant);
  return tai_minus_utc_s(day) * second + kTtMinusTai;
}

AstronomicalTime astronomical_time(const Instant& instant, Duration dut1,
                                   std::optional<Duration> tt_minus_ut1) {
  const bool stamp_is_ut1 = utc_day(instant) < kLeapSecondEra;
  const double dut1_s = stamp_is_ut1 ? 0.0 : dut1.in(second);
  const microseconds since_j2000 = instant.utc - (kJ2000Day + kHalfDay);
  const days whole = floor<days>(since_j2000);
  const double fraction = static_cast<double>((since_j2000 - whole).count()) / kMicrosecondsPerDay;
  const double tt_minus_stamp_s =
      tt_minus_ut1 ? tt_minus_ut1->in(second) + dut1_s : tt_minus_utc(instant).in(second);
  const double whole_days = static_cast<double>(whole.count());
  return {.tt_days = whole_days + (fraction + tt_minus_stamp_s / kSecondsPerDay),
          .ut1_whole_days = whole_days,
          .ut1_day_fraction = fraction + dut1_s / kSecondsPerDay};
}

}  // namespace skylapse::astro
