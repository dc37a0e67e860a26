#include "astro/events.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "astro/event_search.h"

namespace skylapse::astro {
namespace {

constexpr std::array<std::pair<EventKind, const char*>, kEventKindCount> kNames{{
    {EventKind::solar_noon, "solar_noon"},
    {EventKind::solar_midnight, "solar_midnight"},
    {EventKind::sunrise, "sunrise"},
    {EventKind::sunset, "sunset"},
    {EventKind::civil_dawn, "civil_dawn"},
    {EventKind::civil_dusk, "civil_dusk"},
    {EventKind::nautical_dawn, "nautical_dawn"},
    {EventKind::nautical_dusk, "nautical_dusk"},
    {EventKind::astro_dawn, "astro_dawn"},
    {EventKind::astro_dusk, "astro_dusk"},
    {EventKind::moonrise, "moonrise"},
    {EventKind::moonset, "moonset"},
}};

/// 34' of refraction at the horizon + 16' of solar radius (the almanacs' convention).
constexpr Angle kSunriseLevel = -50.0 * arcmin;
constexpr Angle kHorizonRefraction = 34.0 * arcmin;
constexpr RefractionConditions kAirless{.enabled = false};

/// The sun needs half an hour even from one grazing contact to the next extreme of its path, the
/// moon likewise: ten minutes hold no two extremes.
constexpr double kStepSeconds = 600;

struct TwilightLevel {
  Angle level;
  EventKind rising, setting;
};
constexpr std::array<TwilightLevel, 4> kSunLevels{{
    {kSunriseLevel, EventKind::sunrise, EventKind::sunset},
    {-6.0 * deg, EventKind::civil_dawn, EventKind::civil_dusk},
    {-12.0 * deg, EventKind::nautical_dawn, EventKind::nautical_dusk},
    {-18.0 * deg, EventKind::astro_dawn, EventKind::astro_dusk},
}};

/// One observer's sky as functions of the seconds after `origin`; angles in degrees.
class Sky {
 public:
  Sky(const Ephemeris& ephemeris, const GeodeticPosition& observer, const Instant& origin)
      : ephemeris_(ephemeris), observer_(observer), origin_(origin) {}
  [[nodiscard]] Instant at(double t) const { return origin_ + t * second; }
  [[nodiscard]] double sun_elevation(double t) const { return elevation(sun(t)).in(deg); }
  [[nodiscard]] double sun_east(double t) const { return sun(t).x(); }
  /// Of the upper limb, lifted by the horizon's refraction: 0 at moonrise and moonset.
  [[nodiscard]] double moon_limb(double t) const {
    const SkyState state = ephemeris_.sky_state(at(t), observer_, kAirless);
    return (elevation(state.moon_true) + kHorizonRefraction + state.moon_radius).in(deg);
  }

 private:
  [[nodiscard]] Direction<Enu> sun(double t) const {
    return ephemeris_.sun_state(at(t), observer_, kAirless).sun_true;
  }
  const Ephemeris& ephemeris_;
  GeodeticPosition observer_;
  Instant origin_;
};

/// The same ephemeris with the sun on its own side of the meridian, where preetham's arctan loses
/// it; elevations are the same. Nothing if `ephemeris` knows the side.
std::optional<Ephemeris> full_circle_of(const Ephemeris& ephemeris) {
  if (ephemeris.options().algorithm != SunAlgorithm::preetham) return std::nullopt;
  EphemerisOptions options = ephemeris.options();
  options.algorithm = SunAlgorithm::preetham_atan2;
  return Ephemeris(options);
}

struct RiseAndSet {
  EventTimes rising, setting;
};

/// Sorts the crossings of one level, with the state of an absent one.
RiseAndSet rise_and_set(const Sky& sky, const SampledCurve& curve, double level) {
  RiseAndSet found;
  auto& [up, down] = found;
  for (const SampledCurve::Crossing& c : curve.crossings(level))
    (c.rising ? up : down).times.push_back(sky.at(c.time_s));
  if (up.times.empty() && down.times.empty())
    up.absent = down.absent =
        curve.value_at_begin() < level ? AbsentEvent::below : AbsentEvent::above;
  return found;
}

/// Extreme of the samples at whole minutes after the day's start, both bounds of the day included;
/// sign +1: the largest.
Angle minute_extreme(const Sky& sky, const SampledCurve& elevation_curve, double length_s,
                     double sign) {
  const auto& samples = elevation_curve.samples();
  const auto inside = [&](const TimeSample& s) { return s.time_s >= 0 && s.time_s <= length_s; };
  double near_s = 0;
  double best = -std::numeric_limits<double>::infinity();
  for (const TimeSample& s : samples)
    if (inside(s) && sign * s.value > best) best = sign * s.value, near_s = s.time_s;
  const double step_minutes = kStepSeconds / 60 + 1;
  const double first = std::max(0.0, std::floor(near_s / 60) - step_minutes);
  const double last = std::min(std::floor(length_s / 60), near_s / 60 + step_minutes);
  best = -std::numeric_limits<double>::infinity();
  for (double m = first; m <= last; ++m) best = std::max(best, sign * sky.sun_elevation(60 * m));
  return sign * best * deg;
}

}  // namespace

std::string name_of(EventKind kind) {
  for (const auto& [candidate, name] : kNames)
    if (candidate == kind) return name;
  assert(false);
  return {};
}

std::optional<EventKind> event_kind_from_name(const std::string& name) {
  for (const auto& [kind, its_name] : kNames)
    if (name == its_name) return kind;
  return std::nullopt;
}

/// What the events of a day are read off, each made when first asked for.
struct DayEventSearch::Curves {
  Curves(const Ephemeris& ephemeris, const GeodeticPosition& observer, const CivilDay& day)
      : full_circle(full_circle_of(ephemeris)),
        sky(full_circle ? *full_circle : ephemeris, observer, day.start),
        length_s((day.end - day.start).in(second)) {}

  const SampledCurve& sun_elevation() {
    return made(elevation_, [this](double t) { return sky.sun_elevation(t); });
  }

  RiseAndSet sun_at(Angle level) { return rise_and_set(sky, sun_elevation(), level.in(deg)); }

  RiseAndSet moon() {
    return rise_and_set(sky, made(moon_, [this](double t) { return sky.moon_limb(t); }), 0);
  }

  EventTimes meridian_passages(bool at_noon) {
    EventTimes found;
    const SampledCurve& east = made(east_, [this](double t) { return sky.sun_east(t); });
    for (const SampledCurve::Crossing& c : east.crossings(0))
      if (c.rising != at_noon) found.times.push_back(sky.at(c.time_s));
    return found;
  }

  const std::optional<Ephemeris> full_circle;  // `sky` refers to it, if there is one
  const Sky sky;
  const double length_s;

 private:
  const SampledCurve& made(std::optional<SampledCurve>& curve, TimeFunction f) const {
    if (!curve) curve.emplace(std::move(f), 0, length_s, kStepSeconds);
    return *curve;
  }
  std::optional<SampledCurve> elevation_, east_, moon_;  // their functions refer to `sky`
};

DayEventSearch::DayEventSearch(const Ephemeris& ephemeris, const GeodeticPosition& observer,
                               const CivilDay& day)
    : curves_(std::make_unique<Curves>(ephemeris, observer, day)) {}
DayEventSearch::~DayEventSearch() = default;
DayEventSearch::DayEventSearch(DayEventSearch&&) noexcept = default;
DayEventSearch& DayEventSearch::operator=(DayEventSearch&&) noexcept = default;

EventTimes DayEventSearch::times_of(EventKind kind) {
  for (const TwilightLevel& l : kSunLevels) {
    if (kind == l.rising) return curves_->sun_at(l.level).rising;
    if (kind == l.setting) return curves_->sun_at(l.level).setting;
  }
  switch (kind) {
    case EventKind::solar_noon:
      return curves_->meridian_passages(true);
    case EventKind::solar_midnight:
      return curves_->meridian_passages(false);
    case EventKind::moonrise:
      return curves_->moon().rising;
    default:
      assert(kind == EventKind::moonset);
      return curves_->moon().setting;
  }
}

DayEvents day_events(const Ephemeris& ephemeris, const GeodeticPosition& observer,
                     const CivilDay& day) {
  DayEvents result{.day = day, .events = {}, .sun_elevation_max = {}, .sun_elevation_min = {}};
  DayEventSearch search(ephemeris, observer, day);
  for (int kind = 0; kind < kEventKindCount; ++kind)
    result.events[size_t(kind)] = search.times_of(EventKind(kind));
  DayEventSearch::Curves& curves = *search.curves_;
  result.sun_elevation_max =
      minute_extreme(curves.sky, curves.sun_elevation(), curves.length_s, +1);
  result.sun_elevation_min =
      minute_extreme(curves.sky, curves.sun_elevation(), curves.length_s, -1);
  return result;
}

std::vector<LevelCrossing> sun_level_crossings(const Ephemeris& ephemeris,
                                               const GeodeticPosition& observer, Instant from,
                                               Instant to, const std::vector<Angle>& levels) {
  const double length = (to - from).in(second);
  if (!(length > 0)) return {};
  const Sky sky(ephemeris, observer, from);
  const SampledCurve curve([&](double t) { return sky.sun_elevation(t); }, 0, length, kStepSeconds);
  std::vector<LevelCrossing> found;
  for (const Angle level : levels)
    for (const SampledCurve::Crossing& c : curve.crossings(level.in(deg)))
      if (c.time_s > 0) found.push_back({sky.at(c.time_s), c.rising, level});
  return found;
}

std::vector<LevelCrossing> sun_level_crossings(const Ephemeris& ephemeris,
                                               const GeodeticPosition& observer, Instant from,
                                               Instant to, Angle level) {
  return sun_level_crossings(ephemeris, observer, from, to, std::vector<Angle>{level});
}

}  // namespace skylapse::astro
