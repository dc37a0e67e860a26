#pragma once
// Rise, set, meridian passages and twilights of one local civil day.
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "astro/ephemeris/ephemeris.h"
#include "astro/time/zone.h"

namespace skylapse::astro {

enum class EventKind {
  solar_noon,
  solar_midnight,
  sunrise,
  sunset,
  civil_dawn,
  civil_dusk,
  nautical_dawn,
  nautical_dusk,
  astro_dawn,
  astro_dusk,
  moonrise,
  moonset,
};
inline constexpr int kEventKindCount = 12;
std::string name_of(EventKind kind);  // "civil_dawn"
std::optional<EventKind> event_kind_from_name(const std::string& name);

/// What stands in place of a time when a crossing does not happen in the day.
enum class AbsentEvent { above, below, none };

struct EventTimes {
  std::vector<Instant> times;  // in order; empty if there is none
  AbsentEvent absent = AbsentEvent::none;
};

struct DayEvents {
  CivilDay day;
  std::array<EventTimes, kEventKindCount> events;
  Angle sun_elevation_max;  // true elevation, extremes of one-minute samples
  Angle sun_elevation_min;
  [[nodiscard]] const EventTimes& of(EventKind kind) const {
    return events[static_cast<int>(kind)];
  }
};

/// Sunrise and sunset: centre at true elevation -50 arcmin. Twilights: -6, -12, -18 deg.
/// Moon: centre at -(34 arcmin + angular radius). Times to 1 ms; grazing days as the model says.
DayEvents day_events(const Ephemeris& ephemeris, const GeodeticPosition& observer,
                     const CivilDay& day);

/// The same, for those events alone that are asked for: a search of each of the sun's elevation,
/// its meridian passages and the moon is made when first needed. Times equal those of day_events.
/// `ephemeris` must outlive it.
class DayEventSearch {
 public:
  DayEventSearch(const Ephemeris& ephemeris, const GeodeticPosition& observer, const CivilDay& day);
  ~DayEventSearch();
  DayEventSearch(DayEventSearch&&) noexcept;
  DayEventSearch& operator=(DayEventSearch&&) noexcept;
  [[nodiscard]] EventTimes times_of(EventKind kind);

 private:
  friend DayEvents day_events(const Ephemeris&, const GeodeticPosition&, const CivilDay&);
  struct Curves;
  std::unique_ptr<Curves> curves_;
};

/// Every instant in (`from`, `to`) at which the sun's true centre crosses `level`, in order; a
/// path that only touches the level from one side does not cross it.
struct LevelCrossing {
  Instant instant;
  bool rising = false;
  Angle level;
};
std::vector<LevelCrossing> sun_level_crossings(const Ephemeris& ephemeris,
                                               const GeodeticPosition& observer, Instant from,
                                               Instant to, Angle level);
/// The same for several levels at the cost of one search; by level, then time.
std::vector<LevelCrossing> sun_level_crossings(const Ephemeris& ephemeris,
                                               const GeodeticPosition& observer, Instant from,
                                               Instant to, const std::vector<Angle>& levels);

}  // namespace skylapse::astro
