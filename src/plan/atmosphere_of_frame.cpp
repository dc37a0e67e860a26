#include "plan/atmosphere_of_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/air_conversion.h"
#include "plan/frame_schedule.h"
#include "plan/plan.h"

namespace skylapse::plan {
namespace {

using config::AirState;
using sky::atmosphere::AirDescription;
using sky::atmosphere::Medium;
using Node = AirTimeline::Node;

/// Between two nodes of tables: this much aerosol more, or this much ozone.
constexpr double kAerosolFactor = 1.25, kOzoneStepDu = 25;
/// Depths much below this hardly show beside the air's own 0.1 at 550 nm: near none the steps are
/// those of a sum, not of a ratio.
constexpr double kAerosolFloor = 0.02;

Result<std::vector<Node>, Diagnostics> nodes_of_site(const config::JobConfig& job,
                                                     const config::Site& site) {
  std::vector<Node> nodes;
  const auto zone = zone_of(job, site);
  if (!zone) return Diagnostics{zone.error()};
  const auto days = days_of_job(job);
  for (const config::AirKeyframe& keyframe : job.air.keyframes) {
    const size_t count = keyframe.time.date ? 1 : days.size();
    for (size_t i = 0; i < count; ++i) {
      // A day that the zone skips has no frames, and no keyframes either.
      if (!keyframe.time.date && !keyframe.time.utc_offset && !zone->civil_day(days[i])) continue;
      const auto at = resolve_time(keyframe.time, days[i], site, *zone);
      if (!at) return Diagnostics{at.error()};
      nodes.push_back({*at, keyframe.state});
    }
  }
  std::stable_sort(nodes.begin(), nodes.end(),
                   [](const Node& a, const Node& b) { return a.at < b.at; });
  for (size_t i = 1; i < nodes.size(); ++i)
    if (!(nodes[i - 1].at < nodes[i].at))
      return Diagnostics{
          {ErrorCode::invalid_input,
           fmt::format("two keyframes of the air fall on {}", format_utc(nodes[i].at)),
           job.air.keyframes.front().time.span, "give each a time of its own"}};
  return nodes;
}

/// Where a frame's air lies: at `fraction` of the way from one state to another.
struct Span {
  AirState from, to;
  double fraction = 0;
};

Span span_of_frame(const std::vector<Node>& nodes, const astro::Instant& instant) {
  const auto after =
      std::find_if(nodes.begin(), nodes.end(), [&](const Node& node) { return instant < node.at; });
  if (after == nodes.begin()) return {nodes.front().state, nodes.front().state};
  if (after == nodes.end()) return {nodes.back().state, nodes.back().state};
  const Node& before = *(after - 1);
  return {before.state, after->state, (instant - before.at) / (after->at - before.at)};
}

AirState state_at(const Span& span, double fraction) {
  const auto mix = [&](double a, double b) { return a + fraction * (b - a); };
  return {mix(span.from.aerosol_optical_depth, span.to.aerosol_optical_depth),
          mix(span.from.ozone_du, span.to.ozone_du)};
}

/// How many steps of the tables' grid lie between the beginning of a span and `fraction` of it.
double steps_to(const Span& span, double fraction) {
  const AirState state = state_at(span, fraction);
  const double ratio = (state.aerosol_optical_depth + kAerosolFloor) /
                       (span.from.aerosol_optical_depth + kAerosolFloor);
  return std::abs(std::log(ratio)) / std::log(kAerosolFactor) +
         std::abs(state.ozone_du - span.from.ozone_du) / kOzoneStepDu;
}

/// The fraction at which `steps` lie behind; steps_to rises with the fraction.
double fraction_at(const Span& span, double steps) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (steps_to(span, middle) < steps ? low : high) = middle;
  }
  return high;
}

/// A span and its reverse share their nodes, so that the tables of a morning serve the evening.
Span in_one_direction(Span span) {
  const auto key = [](const AirState& s) { return std::pair(s.aerosol_optical_depth, s.ozone_du); };
  if (key(span.from) <= key(span.to)) return span;
  return {span.to, span.from, 1 - span.fraction};
}

/// The two states of the grid about a frame, and the share of the second.
struct Bracket {
  AirState a, b;
  double weight = 0;
};

Bracket bracket_of(const Span& given) {
  const Span span = in_one_direction(given);
  const double all = steps_to(span, 1);
  if (all == 0) return {span.from, span.from, 0};
  const double count = std::ceil(all - 1e-9);
  const double step = all / count;
  const double index = std::clamp(std::floor(steps_to(span, span.fraction) / step), 0.0, count - 1);
  const double low = index == 0 ? 0 : fraction_at(span, index * step);
  const double high = index == count - 1 ? 1 : fraction_at(span, (index + 1) * step);
  return {state_at(span, low), state_at(span, high),
          std::clamp((span.fraction - low) / (high - low), 0.0, 1.0)};
}

bool changes(const AirTimeline& timeline, const Frame& frame) {
  return !timeline.sites.empty() && !timeline.sites[frame.site].empty();
}

/// The job's air with the frame's haze and ground.
AirDescription constant_air(const config::JobConfig& job, const Frame& frame) {
  AirDescription air = job.air.description;
  air.aerosol_optical_depth =
      std::max(0.0, config::aerosol_depth_from_turbidity(job.air.turbidity[frame.turbidity].value));
  air.ground_albedo = config::ground_spectrum(job.air.ground_albedo[frame.albedo].value);
  return air;
}

/// Without what the plan leaves out.
AirDescription taken(const AirTimeline& timeline, AirDescription air) {
  if (!timeline.ozone) air.ozone_du = 0;
  if (!timeline.aerosol) air.aerosol_optical_depth = air.stratospheric_optical_depth = 0;
  return air;
}

AirDescription air_in_state(const config::JobConfig& job, const Frame& frame,
                            const AirState& state) {
  AirDescription air = constant_air(job, frame);
  // A list of hazes belongs to frames; keyframes beside it change the ozone alone.
  if (job.air.turbidity.size() == 1) air.aerosol_optical_depth = state.aerosol_optical_depth;
  air.ozone_du = state.ozone_du;
  return air;
}

Result<Medium> medium_of(const config::JobConfig& job, const AirDescription& air) {
  const auto atmosphere = sky::atmosphere::atmosphere_of(air);
  if (!atmosphere) return atmosphere.error();
  return medium_at(*atmosphere, sky::atmosphere::band_edges(job.sky.wavelengths));
}

}  // namespace

Result<AirTimeline, Diagnostics> make_air_timeline(const config::JobConfig& job) {
  AirTimeline timeline;
  if (job.air.keyframes.empty()) return timeline;
  for (const config::Site& site : job.sites) {
    auto nodes = nodes_of_site(job, site);
    if (!nodes) return nodes.error();
    timeline.sites.push_back(*std::move(nodes));
  }
  return timeline;
}

AirDescription air_of_frame(const config::JobConfig& job, const AirTimeline& timeline,
                            const Frame& frame) {
  if (!changes(timeline, frame)) return taken(timeline, constant_air(job, frame));
  const Span span = span_of_frame(timeline.sites[frame.site], frame.instant);
  return taken(timeline, air_in_state(job, frame, state_at(span, span.fraction)));
}

Result<Medium> medium_of_frame(const config::JobConfig& job, const AirTimeline& timeline,
                               const Frame& frame) {
  return medium_of(job, air_of_frame(job, timeline, frame));
}

Result<TableMedia> tables_of_frame(const config::JobConfig& job, const AirTimeline& timeline,
                                   const Frame& frame) {
  if (!changes(timeline, frame)) {
    const auto medium = medium_of_frame(job, timeline, frame);
    if (!medium) return medium.error();
    return TableMedia{*medium, *medium, 0};
  }
  const Bracket bracket = bracket_of(span_of_frame(timeline.sites[frame.site], frame.instant));
  const auto a = medium_of(job, taken(timeline, air_in_state(job, frame, bracket.a)));
  if (!a) return a.error();
  const auto b = medium_of(job, taken(timeline, air_in_state(job, frame, bracket.b)));
  if (!b) return b.error();
  return TableMedia{*a, *b, bracket.weight};
}

}  // namespace skylapse::plan
