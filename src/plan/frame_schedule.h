#pragma once
// Which moments a job renders: sites x days x times, before cameras and parameter lists multiply.
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "astro/events.h"
#include "config/job_config.h"
#include "core/result.h"

namespace skylapse::plan {

/// What made a time one of the job: an elevation in `time.sun_elevations`.
struct AskedSun {
  Angle elevation;  // true, of the sun's centre, as written
  bool rising = false;
};

struct ScheduledTime {
  int site = 0;  // index into JobConfig::sites
  std::chrono::year_month_day date;
  astro::Instant instant;
  astro::LocalTime local;
  std::optional<AskedSun> asked_sun{};  // where the config asks for elevations of the sun
};

struct Schedule {
  /// By site, then time; times of the sun's elevation by site, day, and elevation as written.
  std::vector<ScheduledTime> times;
  /// Days that a zone skips, and elevations that the sun does not reach: for the reader of the
  /// plan.
  std::vector<std::string> notes;
};

/// Resolves every time expression of every site and day. Anchors use the true sun (ERFA), whatever
/// algorithm draws it. Errors keep the span of the expression: a time that the zone skips or
/// repeats, an event that does not happen on that day, an interval that ends before it begins.
Result<Schedule, Diagnostics> make_schedule(const config::JobConfig& job);

/// The zone of a site: its own, else the job's, else UTC (no time of the job needs one then).
Result<astro::Zone> zone_of(const config::JobConfig& job, const config::Site& site);

/// The days of a job in order, each once. Where times carry days of their own: all from the first
/// to the last of them.
std::vector<std::chrono::year_month_day> days_of_job(const config::JobConfig& job);

/// One time expression at one site; `day` is used unless the expression carries a date.
Result<astro::Instant> resolve_time(const config::TimeExpression& time,
                                    const std::chrono::year_month_day& day,
                                    const config::Site& site, const astro::Zone& zone);

}  // namespace skylapse::plan
