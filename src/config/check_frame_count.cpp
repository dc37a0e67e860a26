#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/build_job.h"

namespace skylapse::config {
namespace {

double days_in(const DateRange& range) {
  const auto span = std::chrono::sys_days(range.last) - std::chrono::sys_days(range.first);
  return std::floor(double(span.count()) / range.step_days) + 1;
}

/// An upper bound of the time from `from` to `to`: exact for clock times, and for events of the sun
/// as if they could lie anywhere in their day.
double longest_span_s(const TimePlan& time) {
  const bool comparable =
      time.from && time.to && time.from->date.has_value() == time.to->date.has_value();
  if (!comparable) return 86400;
  const auto edge = [](const TimeExpression& t, double anywhere) {
    const double day =
        t.date ? double(std::chrono::sys_days(*t.date).time_since_epoch().count()) : 0;
    const double clock = t.clock ? double(t.clock->count()) * 1e-6 : anywhere;
    return day * 86400 + clock + t.offset.in(second);
  };
  const double zones = time.from->utc_offset != time.to->utc_offset ? 86400 : 7200;
  return std::max(0.0, edge(*time.to, 86400) - edge(*time.from, 0) + zones);
}

/// Most frames of one site and day.
double frames_per_day(const TimePlan& time) {
  if (const auto* list = std::get_if<ExplicitTimes>(&time.sampling))
    return double(list->times.size());
  if (const auto* count = std::get_if<FrameCount>(&time.sampling)) return double(count->count);
  if (const auto* elevations = std::get_if<SunElevations>(&time.sampling))
    return double(elevations->elevations.size()) *
           (elevations->half == SunElevations::Half::both ? 2 : 1);
  const double span = longest_span_s(time);
  if (const auto* step = std::get_if<FixedStep>(&time.sampling))
    return std::floor(span / step->step.in(second)) + 1;
  const Angle step = std::get<ElevationStep>(time.sampling).step;
  // The sun rises and sinks once a day, through 180 degrees at most each way.
  return std::ceil(span / 86400) * 2 * (std::floor(180 * deg / step) + 1);
}

std::string_view sampling_key(const Sampling& sampling) {
  switch (sampling.index()) {
    case 0:
      return "step";
    case 1:
      return "frames";
    case 2:
      return "every";
    case 3:
      return "at";
    default:
      return "sun_elevations";
  }
}

/// More days than this are not searched for events of the sky in one job: 27 years of one site. At
/// 1.7 ms each (most of it nutation, at every hour of the day) this takes some 17 s.
constexpr double kMaxSearchedDays = 10'000;

/// Days of one site and day of the job that are searched for the sun and moon.
double searched_days(const TimePlan& time) {
  if (std::holds_alternative<ElevationStep>(time.sampling))
    return std::max(1.0, std::ceil(longest_span_s(time) / 86400));
  if (std::holds_alternative<SunElevations>(time.sampling)) return 1;
  const auto anchored = [](const std::optional<TimeExpression>& t) { return t && t->anchor; };
  if (anchored(time.from) || anchored(time.to)) return 1;
  const auto* list = std::get_if<ExplicitTimes>(&time.sampling);
  if (list == nullptr) return 0;
  // Times with days of their own may each need another day.
  return double(std::count_if(list->times.begin(), list->times.end(),
                              [](const TimeExpression& t) { return t.anchor && t.date; })) +
         double(std::any_of(list->times.begin(), list->times.end(),
                            [](const TimeExpression& t) { return t.anchor && !t.date; }));
}

/// Events of the sky cost time however few frames they give.
void check_searched_days(const Section& time, const JobConfig& job, double days,
                         const ReadContext& context) {
  const double searched = searched_days(job.time) * days * double(job.sites.size());
  if (searched <= kMaxSearchedDays) return;
  context.errors.add(
      time.place_of(sampling_key(job.time.sampling)),
      fmt::format("the events of up to {:.6g} days would have to be found", searched),
      fmt::format("allowed: at most {} days and locations together; use fewer, or clock times",
                  kMaxSearchedDays));
}

/// Days on which keyframes without a day fall: those of the job, or all between the times that
/// carry a day of their own.
double keyframe_days(const TimePlan& time, double days) {
  if (!time.dates.empty()) return days;
  std::vector<std::chrono::sys_days> own;
  const auto add = [&](const TimeExpression& t) {
    if (t.date) own.emplace_back(*t.date);
  };
  if (time.from) add(*time.from);
  if (time.to) add(*time.to);
  if (const auto* list = std::get_if<ExplicitTimes>(&time.sampling))
    for (const TimeExpression& t : list->times) add(t);
  if (own.empty()) return days;
  const auto [first, last] = std::minmax_element(own.begin(), own.end());
  return double((*last - *first).count()) + 1;
}

/// Keyframes without a day fall on every day of every site; anchored ones need its events.
void check_keyframes(const Section& root, const JobConfig& job, double days,
                     const ReadContext& context) {
  const auto air = only_section(root, "air");
  if (!air || job.air.keyframes.empty()) return;
  const double everywhere = days * double(job.sites.size());
  double instants = 0, searches = 0;
  for (const AirKeyframe& keyframe : job.air.keyframes) {
    const double count = keyframe.time.date ? double(job.sites.size()) : everywhere;
    instants += count;
    if (keyframe.time.anchor) searches += count;
  }
  if (instants > double(kMaxJobFrames))
    context.errors.add(
        air->place_of("keyframes"), fmt::format("the keyframes fall on {:.3g} moments", instants),
        fmt::format("allowed: at most {} keyframes x days x locations", kMaxJobFrames));
  if (searches > kMaxSearchedDays)
    context.errors.add(
        air->place_of("keyframes"),
        fmt::format("the events of up to {:.6g} days would have to be found", searches),
        fmt::format("allowed: at most {} keyframes x days x locations; use clock times",
                    kMaxSearchedDays));
}

}  // namespace

void check_frame_count(const Section& root, const JobConfig& job, const ReadContext& context) {
  const auto time = only_section(root, "time");
  if (!time) return;
  double days = job.time.dates.empty() ? 1 : 0;
  for (const DateRange& range : job.time.dates) days += days_in(range);
  check_keyframes(root, job, keyframe_days(job.time, days), context);
  const double per_day = frames_per_day(job.time);
  const double lists = double(job.sites.size()) * double(job.air.turbidity.size()) *
                       double(job.air.ground_albedo.size()) * double(job.cameras.size());
  const double frames = per_day * days * lists;
  if (frames <= double(kMaxJobFrames)) {
    check_searched_days(*time, job, days, context);
    return;
  }
  context.errors.add(
      time->place_of(sampling_key(job.time.sampling)),
      fmt::format("this job asks for up to {:.3g} frames", frames),
      fmt::format("allowed: at most {} ({} days x {:.4g} a day x {} combinations of locations, "
                  "cameras and air)",
                  kMaxJobFrames, days, per_day, lists));
}

}  // namespace skylapse::config
