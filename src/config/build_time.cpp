#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "config/build_job.h"
#include "config/time_expression.h"
#include "config/words.h"

namespace skylapse::config {
namespace {

using std::chrono::microseconds;

/// A time that is not written: the beginning or the end of the day of `day`.
TimeExpression day_limit(int hours, const std::optional<std::chrono::year_month_day>& day,
                         const SourceSpan& span) {
  TimeExpression time;
  time.date = day;
  time.clock = std::chrono::hours(hours);
  time.span = span;
  return time;
}

std::vector<TimeExpression> times_of(const Section& section, std::string_view key,
                                     const ReadContext& context) {
  std::vector<TimeExpression> times;
  for (const Value& value : section.values(key)) {
    times.push_back(std::get<TimeExpression>(value.data));
    times.back().span = context.sources.span(value.place);
  }
  return times;
}

std::vector<DateRange> dates_of(const Section& section, const ReadContext& context) {
  std::vector<DateRange> ranges;
  std::set<std::chrono::sys_days> single_days;
  for (const std::string_view key : {"date", "dates"})
    for (const Value& value : section.values(key)) {
      DateRange range = std::get<DateRange>(value.data);
      range.span = context.sources.span(value.place);
      if (range.first == range.last && !single_days.insert(range.first).second)
        context.errors.add(value.place,
                           fmt::format("the day {} is given twice", date_text(range.first)));
      ranges.push_back(range);
    }
  return ranges;
}

/// Days either stand in the expressions, or beside them; half and half has no clear meaning.
void check_days(const Section& section, const ReadContext& context) {
  const bool days_beside = section.has("date") || section.has("dates");
  for (const std::string_view key : {"from", "to", "at"})
    for (const Value& value : section.values(key)) {
      const auto& time = std::get<TimeExpression>(value.data);
      if (days_beside && time.date)
        context.errors.add(
            value.place,
            fmt::format("{} carries a day of its own, and {} is given too", section.path_of(key),
                        section.path_of(section.has("date") ? "date" : "dates")),
            "give the day in one of the two places");
      if (!days_beside && !time.date)
        context.errors.add(value.place, fmt::format("{} has no day", section.path_of(key)),
                           "add \"date: 2026-06-21\" beside it, or write the day before the time");
    }
  const bool has_times = section.has("from") || section.has("to") || section.has("at");
  if (!days_beside && !has_times)
    context.errors.add(section.place, "the job has no day", "add \"date: 2026-06-21\"");
}

bool needs_zone(const TimeExpression& time) { return !time.utc_offset; }

/// Every time by the clock or by the sun belongs to the calendar of some zone.
void check_zones(const Section& section, const std::vector<Site>& sites, bool has_limits,
                 const ReadContext& context) {
  if (section.has("zone")) return;
  const auto without = std::find_if(sites.begin(), sites.end(),
                                    [](const Site& site) { return !site.zone.has_value(); });
  if (without == sites.end()) return;
  const std::string hint =
      "add \"zone: Europe/Prague\" (an IANA name, UTC or +02:00) to time or to the location";
  const std::string who = sites.size() > 1 ? fmt::format(" for {}", without->name) : "";
  bool reported = false;
  for (const std::string_view key : {"from", "to", "at"})
    for (const Value& value : section.values(key)) {
      const auto& time = std::get<TimeExpression>(value.data);
      if (!needs_zone(time)) continue;
      reported = true;
      context.errors.add(
          value.place,
          time.anchor ? fmt::format("{} needs a time zone{}: events are those of a local day",
                                    section.path_of(key), who)
                      : fmt::format("{} has neither a time zone nor an offset{}",
                                    section.path_of(key), who),
          hint);
    }
  const bool limits_missing = has_limits && (!section.has("from") || !section.has("to"));
  if (limits_missing && !reported)
    context.errors.add(section.place, fmt::format("the day has no time zone{}", who), hint);
}

SunElevations sun_elevations_of(const Section& section, const ReadContext& context) {
  SunElevations sampling;
  if (const auto word = section.get<std::string>("half"))
    sampling.half = *value_of(kHalfWords, *word);
  std::set<double> seen;
  for (const Value& value : section.values("sun_elevations")) {
    const double elevation = std::get<double>(value.data);
    if (!seen.insert(elevation).second)
      context.errors.add(value.place, fmt::format("{} lists the same elevation twice",
                                                  section.path_of("sun_elevations")));
    sampling.elevations.push_back(elevation * rad);
  }
  return sampling;
}

Sampling sampling_of(const Section& section, const ReadContext& context) {
  if (const auto step = section.get<double>("step")) return FixedStep{*step * second};
  if (const auto frames = section.get<long>("frames")) return FrameCount{*frames};
  if (const auto every = section.get<double>("every")) return ElevationStep{*every * rad};
  if (section.has("sun_elevations")) return sun_elevations_of(section, context);
  return ExplicitTimes{times_of(section, "at", context)};
}

/// Ends that can be compared without the sun or a zone's rules.
void check_order(const Section& section, const TimePlan& plan, const ReadContext& context) {
  const auto& from = *plan.from;
  const auto& to = *plan.to;
  if (!from.clock || !to.clock || from.date.has_value() != to.date.has_value() ||
      from.utc_offset != to.utc_offset)
    return;
  const auto moment = [](const TimeExpression& time) {
    const double days =
        time.date ? double(std::chrono::sys_days(*time.date).time_since_epoch().count()) : 0.0;
    return days * 86400 + double(time.clock->count()) * 1e-6 + time.offset.in(second);
  };
  if (moment(to) < moment(from))
    context.errors.add(section.has("to") ? section.place_of("to") : section.place_of("from"),
                       "the time span ends before it begins",
                       "a span over midnight: write `to` as 24:00 + 4 h, or give both a day");
}

void refuse_limits(const Section& section, const ReadContext& context) {
  const bool at = section.has("at");
  for (const std::string_view key : {"from", "to"})
    if (section.has(key))
      context.errors.add(
          section.field(key)->key_place,
          fmt::format("{} has no meaning beside {}", section.path_of(key),
                      section.path_of(at ? "at" : "sun_elevations")),
          at ? "`at` lists the times themselves"
             : "`sun_elevations` looks at whole days; `half` takes one half of them");
}

void check_half(const Section& section, const ReadContext& context) {
  if (section.has("half") && !section.has("sun_elevations"))
    context.errors.add(section.field("half")->key_place,
                       fmt::format("{} has no meaning here", section.path_of("half")),
                       "it belongs to sun_elevations");
}

}  // namespace

TimePlan build_time(const Section& root, const std::vector<Site>& sites,
                    const ReadContext& context) {
  TimePlan plan;
  const auto found = only_section(root, "time");
  if (!found) return plan;
  const Section& section = *found;
  plan.span = context.sources.span(section.place);
  if (const auto zone = section.get<std::string>("zone"))
    plan.zone = Spanned<std::string>{*zone, context.sources.span(section.place_of("zone"))};
  plan.dates = dates_of(section, context);
  plan.dut1 = section.get<double>("dut1").value_or(0) * second;
  plan.sampling = sampling_of(section, context);
  const bool has_limits = !section.has("at");
  check_days(section, context);
  check_zones(section, sites, has_limits, context);
  check_half(section, context);
  if (!has_limits || section.has("sun_elevations")) refuse_limits(section, context);
  if (!has_limits) return plan;
  const auto from = times_of(section, "from", context), to = times_of(section, "to", context);
  const bool bad = (section.has("from") && from.empty()) || (section.has("to") && to.empty());
  if (bad) return plan;
  using Day = std::optional<std::chrono::year_month_day>;
  const Day from_day = from.empty() ? Day{} : from[0].date,
            to_day = to.empty() ? Day{} : to[0].date;
  plan.from = from.empty() ? day_limit(0, to_day, plan.span) : from[0];
  plan.to = to.empty() ? day_limit(24, from_day, plan.span) : to[0];
  check_order(section, plan, context);
  return plan;
}

}  // namespace skylapse::config
