#include "plan/frame_schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "config/time_expression.h"
#include "plan/sun_elevation_times.h"

namespace skylapse::plan {
namespace {

using astro::Instant;
using std::chrono::year_month_day;

Error error_at(const SourceSpan& span, std::string message, std::string hint = {}) {
  return {ErrorCode::invalid_input, std::move(message), span, std::move(hint)};
}

/// Events of the days of one site; the searches of the last few days are kept, as the times of a
/// day ask for one after another.
class SiteDays {
 public:
  SiteDays(const config::Site& site, astro::Zone zone) : site_(site), zone_(std::move(zone)) {}
  [[nodiscard]] const astro::Zone& zone() const { return zone_; }
  [[nodiscard]] const config::Site& site() const { return site_; }
  [[nodiscard]] const astro::Ephemeris& ephemeris() const { return ephemeris_; }

  Result<astro::EventTimes> events(const year_month_day& date, astro::EventKind kind) {
    auto known = searches_.find(std::chrono::sys_days(date));
    if (known == searches_.end()) {
      const auto day = zone_.civil_day(date);
      if (!day) return day.error();
      if (searches_.size() >= kDaysKept) searches_.clear();
      known = searches_
                  .emplace(std::chrono::sys_days(date),
                           astro::DayEventSearch(ephemeris_, site_.position, *day))
                  .first;
    }
    return known->second.times_of(kind);
  }

 private:
  static constexpr size_t kDaysKept = 8;  // several kB each
  const config::Site& site_;
  astro::Zone zone_;
  astro::Ephemeris ephemeris_;
  std::map<std::chrono::sys_days, astro::DayEventSearch> searches_;
};

std::string why_absent(astro::AbsentEvent absent, astro::EventKind kind, const year_month_day& date,
                       const std::string& site) {
  const std::string where = fmt::format("at {} on {}", site, config::date_text(date));
  switch (absent) {
    case astro::AbsentEvent::above:
      return fmt::format("there is no {} {}: it stays above that level all day", name_of(kind),
                         where);
    case astro::AbsentEvent::below:
      return fmt::format("there is no {} {}: it stays below that level all day", name_of(kind),
                         where);
    case astro::AbsentEvent::none:
      break;
  }
  return fmt::format("there is no {} {}", name_of(kind), where);
}

/// 00:00 and 24:00 are the limits of the zone's day, also where no clock shows them or one shows
/// them twice; any other clock time must exist once.
Result<Instant> resolve_in_zone(const config::TimeExpression& time, const year_month_day& date,
                                const astro::WallTime& wall, const astro::Zone& zone) {
  const auto day = zone.civil_day(date);
  if (!day) return day.error();
  if (*time.clock == std::chrono::hours(0)) return day->start;
  if (*time.clock == std::chrono::hours(24) && !time.leap_second) return day->end;
  return zone.to_instant(wall);
}

Result<Instant> resolve_clock(const config::TimeExpression& time, const year_month_day& date,
                              const astro::Zone& zone) {
  const astro::WallTime wall{std::chrono::local_days(date).time_since_epoch() + *time.clock};
  if (!time.utc_offset) return resolve_in_zone(time, date, wall, zone);
  Instant instant{
      std::chrono::sys_time<std::chrono::microseconds>(wall.time_since_epoch() - *time.utc_offset)};
  if (time.leap_second)  // 23:59:60 is written as the last second plus one: mark it as itself
    instant.leap_second = true;
  return instant;
}

Result<Instant> resolve(const config::TimeExpression& time, const year_month_day& day,
                        SiteDays& days) {
  const year_month_day date = time.date.value_or(day);
  Result<Instant> base = [&]() -> Result<Instant> {
    if (time.clock) return resolve_clock(time, date, days.zone());
    const auto found = days.events(date, *time.anchor);
    if (!found) return found.error();
    if (found->times.empty())
      return Error{ErrorCode::invalid_input,
                   why_absent(found->absent, *time.anchor, date, days.site().name),
                   {},
                   "use a clock time such as 00:00, or another day"};
    return found->times.front();
  }();
  if (!base) {
    Error error = base.error();
    error.span = time.span;
    return error;
  }
  return time.offset.in(second) == 0 ? *base : *base + time.offset;
}

struct Interval {
  Instant from, to;
};

Result<std::vector<Instant>> by_step(const Interval& span, Duration step, const SourceSpan& place) {
  const double length = (span.to - span.from).in(second);
  const double count = std::floor(length / step.in(second) + 1e-9) + 1;
  if (count > double(config::kMaxJobFrames))
    return error_at(place, fmt::format("this asks for {:.3g} frames", count),
                    fmt::format("allowed: at most {} frames in a job", config::kMaxJobFrames));
  std::vector<Instant> times;
  for (long i = 0; i < long(count); ++i) times.push_back(span.from + double(i) * step);
  return times;
}

std::vector<Instant> by_count(const Interval& span, long count) {
  std::vector<Instant> times;
  const Duration length = span.to - span.from;
  for (long i = 0; i < count; ++i)
    times.push_back(count == 1 ? span.from : span.from + length * (double(i) / double(count - 1)));
  return times;
}

std::vector<Instant> by_elevation(const Interval& span, Angle step, const SiteDays& days) {
  std::vector<Angle> levels;
  const int highest = int(std::floor(90.0 / step.in(deg)));
  for (int k = -highest; k <= highest; ++k) levels.push_back(double(k) * step);
  std::vector<Instant> times;
  for (const auto& crossing : astro::sun_level_crossings(days.ephemeris(), days.site().position,
                                                         span.from, span.to, levels))
    times.push_back(crossing.instant);
  std::sort(times.begin(), times.end());
  return times;
}

Result<Interval> interval_of(const config::TimePlan& plan, const year_month_day& date,
                             SiteDays& days) {
  auto from = resolve(*plan.from, date, days);
  if (!from) return from.error();
  auto to = resolve(*plan.to, date, days);
  if (!to) return to.error();
  if (*to < *from)
    return error_at(plan.to->span,
                    fmt::format("the interval ends ({}) before it begins ({})", format_utc(*to),
                                format_utc(*from)),
                    "give `to` a date of its own if it lies on the next day");
  return Interval{*from, *to};
}

Result<std::vector<Instant>> times_of_day(const config::TimePlan& plan, const year_month_day& date,
                                          SiteDays& days) {
  if (const auto* list = std::get_if<config::ExplicitTimes>(&plan.sampling)) {
    std::vector<Instant> times;
    for (const auto& time : list->times) {
      auto instant = resolve(time, date, days);
      if (!instant) return instant.error();
      times.push_back(*instant);
    }
    return times;
  }
  auto span = interval_of(plan, date, days);
  if (!span) return span.error();
  if (const auto* step = std::get_if<config::FixedStep>(&plan.sampling))
    return by_step(*span, step->step, plan.span);
  if (const auto* count = std::get_if<config::FrameCount>(&plan.sampling))
    return by_count(*span, count->count);
  return by_elevation(*span, std::get<config::ElevationStep>(plan.sampling).step, days);
}

std::string why_no_frame(const config::TimePlan& time) {
  if (std::holds_alternative<config::ElevationStep>(time.sampling))
    return "the sun passes no multiple of `every` in it: choose a smaller angle or a longer span";
  if (std::holds_alternative<config::SunElevations>(time.sampling))
    return "the sun passes none of these elevations on these days: choose others";
  return "choose days that exist in the time zone";
}

struct JobDay {
  year_month_day date;
  const config::DateRange* range = nullptr;  // null: the expressions carry their own days
};

/// The days of a job; without dates of their own, expressions carry one, and any day will do.
std::vector<JobDay> days_of(const config::TimePlan& plan) {
  std::vector<JobDay> days;
  for (const auto& range : plan.dates)
    for (auto day = std::chrono::sys_days(range.first); day <= std::chrono::sys_days(range.last);
         day += std::chrono::days(range.step_days))
      days.push_back({day, &range});
  if (days.empty()) {
    const auto* list = std::get_if<config::ExplicitTimes>(&plan.sampling);
    const auto& first = plan.from ? *plan.from : list->times.front();
    days.push_back({first.date.value_or(year_month_day{}), nullptr});
  }
  return days;
}

}  // namespace

Result<astro::Zone> zone_of(const config::JobConfig& job, const config::Site& site) {
  const auto& name = site.zone ? site.zone : job.time.zone;
  if (!name) return astro::Zone::find("UTC");  // config made sure that no naive time needs it
  auto zone = astro::Zone::find(name->value);
  if (zone) return zone;
  Error error = zone.error();
  error.span = name->span;
  return error;
}

std::vector<year_month_day> days_of_job(const config::JobConfig& job) {
  std::vector<std::chrono::sys_days> days;
  for (const JobDay& day : days_of(job.time)) days.emplace_back(day.date);
  if (job.time.dates.empty()) {
    const auto add = [&](const config::TimeExpression& time) {
      if (time.date) days.emplace_back(*time.date);
    };
    if (job.time.from) add(*job.time.from);
    if (job.time.to) add(*job.time.to);
    if (const auto* list = std::get_if<config::ExplicitTimes>(&job.time.sampling))
      for (const auto& time : list->times) add(time);
    std::sort(days.begin(), days.end());
    const auto span = days.back() - days.front();  // frames may fall on any day between
    const auto first = days.front();
    days.clear();
    for (auto day = first; day <= first + span; day += std::chrono::days(1)) days.push_back(day);
  }
  std::sort(days.begin(), days.end());
  days.erase(std::unique(days.begin(), days.end()), days.end());
  return {days.begin(), days.end()};
}

Result<Instant> resolve_time(const config::TimeExpression& time, const year_month_day& day,
                             const config::Site& site, const astro::Zone& zone) {
  SiteDays days(site, zone);
  return resolve(time, day, days);
}

Result<Schedule, Diagnostics> make_schedule(const config::JobConfig& job) {
  Schedule schedule;
  Diagnostics errors;
  const auto days = days_of(job.time);
  const auto* elevations = std::get_if<config::SunElevations>(&job.time.sampling);
  for (size_t s = 0; s < job.sites.size() && errors.empty(); ++s) {
    auto zone = zone_of(job, job.sites[s]);
    if (!zone) return Diagnostics{zone.error()};
    SiteDays site_days(job.sites[s], *zone);
    std::optional<SunElevationTimes> asked_sun;
    if (elevations != nullptr) asked_sun.emplace(*elevations, job.sites[s], site_days.ephemeris());
    for (const auto& [date, range] : days) {
      if (range != nullptr) {
        auto day = zone->civil_day(date);
        if (!day && range->first == range->last) {
          errors.push_back(day.error());
          errors.back().span = range->span;
          break;
        }
        if (!day) {
          schedule.notes.push_back(fmt::format("{} {}: this day does not exist in {}; passed over",
                                               job.sites[s].name, config::date_text(date),
                                               zone->name()));
          continue;
        }
      }
      if (asked_sun) {
        const auto day = zone->civil_day(date);
        if (!day) return Diagnostics{day.error()};
        for (const auto& [instant, sun] : asked_sun->of_day(date, *day))
          schedule.times.push_back({int(s), date, instant, zone->to_local(instant), sun});
        continue;
      }
      auto times = times_of_day(job.time, date, site_days);
      if (!times) {
        errors.push_back(times.error());
        break;
      }
      for (const Instant& instant : *times)
        schedule.times.push_back({int(s), date, instant, zone->to_local(instant), {}});
      if (long(schedule.times.size()) > config::kMaxJobFrames)
        return Diagnostics{error_at(job.time.span, "this job has too many frames",
                                    fmt::format("allowed: at most {}", config::kMaxJobFrames))};
    }
    if (asked_sun)
      for (std::string& note : asked_sun->notes()) schedule.notes.push_back(std::move(note));
  }
  if (!errors.empty()) return errors;
  if (elevations == nullptr)
    std::stable_sort(schedule.times.begin(), schedule.times.end(),
                     [](const ScheduledTime& a, const ScheduledTime& b) {
                       return a.site != b.site ? a.site < b.site : a.instant < b.instant;
                     });
  if (schedule.times.empty())
    return Diagnostics{
        error_at(job.time.span, "no frame falls into this time span", why_no_frame(job.time))};
  return schedule;
}

}  // namespace skylapse::plan
