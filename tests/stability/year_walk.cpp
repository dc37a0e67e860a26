#include "stability/year_walk.h"

#include <fmt/format.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "astro/refraction.h"
#include "color/exposure.h"
#include "plan/sun_for_sky.h"
#include "sky/twilight.h"

namespace skylapse::stability {
namespace {

/// What is looked at in one minute.
struct Minute {
  Direction<Enu> true_sun, apparent_sun, sky_model_sun;
  double refraction_deg = 0, ev = 0, luminance = 0, twilight = 0;
};

/// Illuminance of the Hosek-Wilkie sky at sun elevation 0, turbidity 2.5 (twilight_level takes up
/// the difference between it and the published one).
constexpr Illuminance kSkyAtHorizon = 2400.0 * lux;

/// The sun's own light ends here (sky/twilight.h).
constexpr Angle kNight = -18.0 * deg;

Minute look(const astro::Ephemeris& ephemeris, const Place& place, const astro::Instant& instant) {
  const astro::RefractionConditions air;
  const astro::SkyState sky = ephemeris.sun_state(instant, place.position, air);
  const plan::SunForSky fitted = plan::sun_for_sky(sky, air, kSkyAtHorizon);
  const plan::SunForSky computed = plan::sun_for_atmosphere(sky);
  Minute m;
  m.true_sun = sky.sun_true;
  m.apparent_sun = sky.sun_apparent;
  m.sky_model_sun = fitted.direction;
  m.refraction_deg = astro::refraction(elevation(sky.sun_true), air).in(deg);
  const Luminance light = sky::mean_computed_sky_luminance(computed.elevation);
  m.luminance = light.in(cd_per_m2)*computed.distance_factor;
  m.ev = color::sun_curve_ev(light);
  m.twilight = fitted.twilight_level;
  return m;
}

bool sound(const Minute& m) {
  return std::isfinite(m.true_sun.x() + m.apparent_sun.x() + m.sky_model_sun.x() + m.ev) &&
         m.luminance > 0 && m.twilight > 0 && m.twilight <= 1 && m.refraction_deg >= 0 &&
         elevation(m.sky_model_sun) >= -1e-9 * deg;
}

template <class Where>
void note(Step& step, double size, const Where& where) {
  if (size > step.size) step = {size, where()};
}

double stops(double a, double b) { return std::abs(std::log2(a / b)); }

struct Row {
  const char* name;
  const char* unit;
  Step Steps::*step;
};
constexpr std::array<Row, 7> kRows{{{"true sun", "deg", &Steps::true_sun},
                                    {"apparent sun", "deg", &Steps::apparent_sun},
                                    {"sun of the fitted sky", "deg", &Steps::sky_model_sun},
                                    {"refraction", "deg", &Steps::refraction},
                                    {"exposure", "EV", &Steps::exposure},
                                    {"luminance of the sky", "stops", &Steps::luminance},
                                    {"twilight of the fitted sky", "stops", &Steps::twilight}}};

}  // namespace

const std::array<Place, 6>& places() {
  static const std::array<Place, 6> kPlaces{
      {{"north pole", {90 * deg, 0 * deg, 0 * metre}},
       {"south pole", {-90 * deg, 0 * deg, 2835 * metre}},
       {"equator (Quito)", {0 * deg, -78.4558 * deg, 2850 * metre}},
       {"Prague", {50.0755 * deg, 14.4378 * deg, 235 * metre}},
       {"polar circle", {66.5622 * deg, 25.8472 * deg, 0 * metre}},
       {"antimeridian (Taveuni)", {-16.8 * deg, 180 * deg, 0 * metre}}}};
  return kPlaces;
}

void Steps::add(const Steps& other) {
  minutes += other.minutes;
  broken += other.broken;
  for (const Row& row : kRows)
    if ((other.*row.step).size > (this->*row.step).size) this->*row.step = other.*row.step;
}

Steps walk(const Place& place, const astro::Instant& begin, long minutes) {
  const astro::Ephemeris ephemeris;
  Steps steps;
  Minute before = look(ephemeris, place, begin);
  for (long i = 1; i <= minutes; ++i) {
    const astro::Instant instant = begin + double(i) * minute;
    const Minute now = look(ephemeris, place, instant);
    const auto where = [&] { return fmt::format("{} {}", place.name, format_utc(instant)); };
    ++steps.minutes;
    steps.broken += sound(now) ? 0 : 1;
    note(steps.true_sun, separation(before.true_sun, now.true_sun).in(deg), where);
    note(steps.apparent_sun, separation(before.apparent_sun, now.apparent_sun).in(deg), where);
    // At night its azimuth, which lights nothing, may run round below the observer's feet.
    if (elevation(now.true_sun) > kNight)
      note(steps.sky_model_sun, separation(before.sky_model_sun, now.sky_model_sun).in(deg), where);
    note(steps.refraction, std::abs(now.refraction_deg - before.refraction_deg), where);
    note(steps.exposure, std::abs(now.ev - before.ev), where);
    note(steps.luminance, stops(now.luminance, before.luminance), where);
    note(steps.twilight, stops(now.twilight, before.twilight), where);
    before = now;
  }
  return steps;
}

Steps bounds() {
  constexpr double kTurn = 0.2507;  // deg a minute
  constexpr double kWithRefraction = 4.0 / 3 * kTurn;
  constexpr double kStops = 2.1 * kWithRefraction;
  Steps most;
  most.true_sun.size = kTurn;
  most.apparent_sun.size = kWithRefraction;
  most.sky_model_sun.size = kWithRefraction;
  most.refraction.size = kTurn / 3;
  most.exposure.size = 0.86 * kStops;
  most.luminance.size = kStops;
  // Over the first six degrees the fitted sky loses up to 1.6 stops more: that of its own horizon
  // against the published illuminance.
  most.twilight.size = kStops + 1.5 * 1.6 / 6 * kTurn;
  return most;
}

std::string table(const Steps& steps) {
  const Steps most = bounds();
  std::string text = fmt::format("{} minutes, {} broken\n", steps.minutes, steps.broken);
  for (const Row& row : kRows)
    text +=
        fmt::format("{:<28} {:>8.4f} {:<5} bound {:.4f}  {}\n", row.name, (steps.*row.step).size,
                    row.unit, (most.*row.step).size, (steps.*row.step).where);
  return text;
}

bool within_bounds(const Steps& steps) {
  const Steps most = bounds();
  for (const Row& row : kRows)
    if ((steps.*row.step).size > (most.*row.step).size) return false;
  return steps.broken == 0;
}

}  // namespace skylapse::stability
