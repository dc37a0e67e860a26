#include "astro/ephemeris/ephemeris.h"

#include <array>
#include <cmath>
#include <utility>

#include "astro/ephemeris/apparent_place.h"
#include "astro/ephemeris/sun_formulas.h"
#include "astro/refraction.h"
#include "core/constants.h"

namespace skylapse::astro {
namespace {

constexpr std::array<std::pair<SunAlgorithm, const char*>, 4> kNames{{
    {SunAlgorithm::erfa, "erfa"},
    {SunAlgorithm::sg2, "sg2"},
    {SunAlgorithm::preetham_atan2, "preetham-atan2"},
    {SunAlgorithm::preetham, "preetham"},
}};

bool same_place(const GeodeticPosition& a, const GeodeticPosition& b) {
  return a.latitude == b.latitude && a.longitude == b.longitude && a.height == b.height;
}

Angle moon_phase_angle(const ApparentPlace& sun, const ApparentPlace& moon) {
  const auto to_observer = Direction<Celestial>::from_vector(-moon.topocentric_au);
  const auto to_sun = Direction<Celestial>::from_vector(sun.topocentric_au - moon.topocentric_au);
  return separation(to_observer, to_sun);
}

void set_sun(SkyState& state, const Direction<Enu>& direction, Length distance, Angle declination,
             const RefractionConditions& refraction) {
  state.sun_true = direction;
  state.sun_apparent = lift_by_refraction(direction, refraction);
  state.sun_distance = distance;
  state.sun_radius = kSolarRadiusAt1Au / distance.in(astronomical_unit);
  state.sun_declination = declination;
}

}  // namespace

std::optional<SunAlgorithm> sun_algorithm_from_name(const std::string& name) {
  for (const auto& [algorithm, its_name] : kNames)
    if (name == its_name) return algorithm;
  return std::nullopt;
}

std::string name_of(SunAlgorithm algorithm) {
  for (const auto& [candidate, name] : kNames)
    if (candidate == algorithm) return name;
  assert(false);
  return {};
}

struct Ephemeris::Cache {
  EphemerisOptions options;
  CelestialNodes nodes;
  std::optional<GeodeticPosition> place;
  EnuFrame frame;

  const EnuFrame& frame_at(const GeodeticPosition& observer) {
    if (!place || !same_place(*place, observer)) {
      frame = enu_frame(observer);
      place = observer;
    }
    return frame;
  }

  AstronomicalTime time_at(const Instant& instant) const {
    return astronomical_time(instant, options.dut1, options.tt_minus_ut1);
  }

  SkyFrames frames_at(const Instant& instant, const GeodeticPosition& observer) {
    const AstronomicalTime time = time_at(instant);
    return sky_frames(time, nodes.at(time.tt_days), frame_at(observer));
  }

  Direction<Enu> seen_from(const ApparentPlace& place_of_body) const {
    return Direction<Enu>::from_vector(frame.to_enu(place_of_body.earth_fixed_direction));
  }

  void set_erfa_sun(SkyState& state, const SkyFrames& frames, const ApparentPlace& sun,
                    const RefractionConditions& refraction) const {
    set_sun(state, seen_from(sun), sun.geocentric_distance_au * astronomical_unit,
            sun_declination(frames), refraction);
  }

  void set_formula_sun(SkyState& state, const Instant& instant, const GeodeticPosition& observer,
                       const RefractionConditions& refraction) const {
    const FormulaSun sun = options.algorithm == SunAlgorithm::sg2
                               ? sg2_sun(time_at(instant), observer)
                               : preetham_sun(instant, observer,
                                              options.algorithm == SunAlgorithm::preetham
                                                  ? AzimuthBranch::half_circle
                                                  : AzimuthBranch::full_circle);
    set_sun(state, sun.direction, sun.distance, sun.declination, refraction);
  }
};

Ephemeris::Ephemeris(EphemerisOptions options) : cache_(std::make_unique<Cache>()) {
  cache_->options = options;
}
Ephemeris::~Ephemeris() = default;
Ephemeris::Ephemeris(Ephemeris&&) noexcept = default;
Ephemeris& Ephemeris::operator=(Ephemeris&&) noexcept = default;

const EphemerisOptions& Ephemeris::options() const { return cache_->options; }

SkyState Ephemeris::sun_state(const Instant& instant, const GeodeticPosition& observer,
                              const RefractionConditions& refraction) const {
  SkyState state;
  if (cache_->options.algorithm == SunAlgorithm::erfa) {
    const SkyFrames frames = cache_->frames_at(instant, observer);
    cache_->set_erfa_sun(state, frames, sun_place(frames), refraction);
  } else {
    cache_->set_formula_sun(state, instant, observer, refraction);
  }
  return state;
}

SkyState Ephemeris::sky_state(const Instant& instant, const GeodeticPosition& observer,
                              const RefractionConditions& refraction) const {
  SkyState state;
  const SkyFrames frames = cache_->frames_at(instant, observer);
  const ApparentPlace sun = sun_place(frames);
  const ApparentPlace moon = moon_place(frames);
  if (cache_->options.algorithm == SunAlgorithm::erfa)
    cache_->set_erfa_sun(state, frames, sun, refraction);
  else
    cache_->set_formula_sun(state, instant, observer, refraction);
  state.moon_true = cache_->seen_from(moon);
  state.moon_apparent = lift_by_refraction(state.moon_true, refraction);
  state.moon_distance = glm::length(moon.topocentric_au) * astronomical_unit;
  const double distance_ratio = kMoonRadius / state.moon_distance;
  state.moon_radius = atan2_angle(distance_ratio, std::sqrt(1 - distance_ratio * distance_ratio));
  state.moon_phase_angle = moon_phase_angle(sun, moon);
  state.moon_illuminated_fraction = (1 + cos(state.moon_phase_angle)) / 2;
  return state;
}

}  // namespace skylapse::astro
