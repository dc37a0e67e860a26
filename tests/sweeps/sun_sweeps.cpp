// Where the sun is, over all times and places that a config may name.
#include <fmt/format.h>

#include <array>

#include "astro/ephemeris/ephemeris.h"
#include "astro/geodesy/enu_frame.h"
#include "astro/refraction.h"
#include "astro/time/instant.h"
#include "sweeps/sweep.h"

namespace skylapse::sweeps {
namespace {

using namespace skylapse::astro;

/// 1900 to 2199, by the microsecond.
Instant draw_instant(Draw& draw) {
  using namespace std::chrono;
  const auto first = sys_days(year(1900) / 1 / 1), last = sys_days(year(2200) / 1 / 1);
  const auto span = duration_cast<microseconds>(last - first).count();
  return {first + microseconds(long(draw.in(0, double(span - 1))))};
}

GeodeticPosition draw_place(Draw& draw) {
  return {draw.in(-90, 90) * deg, draw.in(-360, 360) * deg, draw.in(-500, 36e6) * metre};
}

std::string text_of(const Instant& instant, const GeodeticPosition& place) {
  return fmt::format("{} at {:.17g} deg {:.17g} deg {:.17g} m", format_utc(instant, 6),
                     place.latitude.in(deg), place.longitude.in(deg), place.height.in(metre));
}

double off_unit(const Direction<Enu>& d) { return std::abs(std::hypot(d.x(), d.y(), d.z()) - 1); }

/// One hour at several places: what is slow is kept per hour, so an hour is looked at many times.
void one_hour(SunAlgorithm algorithm, Draw& draw, Tally& tally) {
  const Ephemeris ephemeris({.algorithm = algorithm});
  const Instant begin = draw_instant(draw);
  for (int i = 0; i < 50; ++i) {
    const Instant instant = begin + draw.in(0, 3599) * second;
    const GeodeticPosition place = draw_place(draw);
    const auto where = [&] { return text_of(instant, place); };
    const SkyState sky = ephemeris.sun_state(instant, place, {});
    const double sum = sky.sun_true.x() + sky.sun_true.y() + sky.sun_true.z() +
                       sky.sun_apparent.z() + sky.sun_distance.in(astronomical_unit) +
                       sky.sun_radius.in(deg) + sky.sun_declination.in(deg);
    if (!tally.finite(sum, where)) continue;
    tally.law(std::abs(sky.sun_distance.in(astronomical_unit)-1) < 0.02, where);
    tally.law(abs(sky.sun_declination) < 23.6 * deg, where);
    tally.law(elevation(sky.sun_apparent) >= elevation(sky.sun_true) - 1e-12 * deg, where);
    tally.error(std::max(off_unit(sky.sun_true), off_unit(sky.sun_apparent)), where);
  }
}

void add_ephemerides(std::vector<Sweep>& sweeps) {
  for (const SunAlgorithm algorithm : {SunAlgorithm::erfa, SunAlgorithm::sg2,
                                       SunAlgorithm::preetham_atan2, SunAlgorithm::preetham})
    sweeps.push_back({"sun: " + name_of(algorithm), "length of the direction less 1", 1e-15,
                      "a unit vector in double", 0.02,
                      [algorithm](Draw& draw, Tally& tally) { one_hour(algorithm, draw, tally); }});
  sweeps.push_back(
      {"moon: erfa", "length of the direction less 1", 1e-15, "a unit vector in double", 2e-3,
       [](Draw& draw, Tally& tally) {
         const Ephemeris ephemeris;
         const Instant begin = draw_instant(draw);
         for (int i = 0; i < 50; ++i) {
           const Instant instant = begin + draw.in(0, 3599) * second;
           const GeodeticPosition place = draw_place(draw);
           const auto where = [&] { return text_of(instant, place); };
           const SkyState sky = ephemeris.sky_state(instant, place, {});
           if (!tally.finite(sky.moon_true.x() + sky.moon_true.z() + sky.moon_apparent.z() +
                                 sky.moon_radius.in(deg) + sky.moon_phase_angle.in(deg),
                             where))
             continue;
           tally.law(sky.moon_illuminated_fraction >= 0 && sky.moon_illuminated_fraction <= 1,
                     where);
           tally.error(std::max(off_unit(sky.moon_true), off_unit(sky.moon_apparent)), where);
         }
       }});
}

void add_geodesy(std::vector<Sweep>& sweeps) {
  sweeps.push_back({"geodesy: enu_frame", "axes off orthonormal", 1e-15, "unit vectors in double",
                    1, [](Draw& draw, Tally& tally) {
                      const GeodeticPosition place = draw_place(draw);
                      const auto where = [&] { return text_of({}, place); };
                      const EnuFrame f = enu_frame(place);
                      if (!tally.finite(glm::dot(f.origin_m, f.origin_m), where)) return;
                      tally.law(glm::dot(glm::cross(f.east, f.north), f.up) > 0.999999, where);
                      double worst = 0;
                      const std::array axes{f.east, f.north, f.up};
                      for (int i = 0; i < 3; ++i)
                        for (int j = 0; j <= i; ++j)
                          worst =
                              std::max(worst, std::abs(glm::dot(axes[size_t(i)], axes[size_t(j)]) -
                                                       (i == j ? 1 : 0)));
                      tally.error(worst, where);
                    }});
  sweeps.push_back(
      {"frames: azimuth and elevation", "rad, there and back", 2e-15,
       "atan2 and two sines; a right angle from its cosine would have half the digits", 1,
       [](Draw& draw, Tally& tally) {
         const Angle az = draw.in(0, 360) * deg, el = draw.in(-90, 90) * deg;
         const auto where = [&] {
           return fmt::format("azimuth {:.17g} elevation {:.17g} deg", az.in(deg), el.in(deg));
         };
         const auto d = enu_direction(az, el);
         if (!tally.finite(azimuth(d).in(deg), where)) return;
         tally.law(azimuth(d) >= 0 * deg && azimuth(d) < 360.0000000001 * deg, where);
         tally.law(abs(elevation(d)) <= 90.0000000001 * deg, where);
         tally.error(separation(d, enu_direction(azimuth(d), elevation(d))).in(rad), where);
       }});
}

void add_refraction(std::vector<Sweep>& sweeps) {
  sweeps.push_back({"astro: refraction", "deg by which lifting turns back", 1e-12,
                    "the rounding of h + R", 1, [](Draw& draw, Tally& tally) {
                      RefractionConditions air;
                      air.pressure = draw.in(0, 1100) * hPa;
                      air.temperature = draw.in(-90, 60) * degC;
                      const double h = draw.in(-90, 90);
                      const double higher = std::min(90.0, h + draw.magnitude(1e-12, 5));
                      const auto where = [&] {
                        return fmt::format("h {:.17g} deg P {:.17g} T {:.17g}", h,
                                           air.pressure.in(hPa), air.temperature.in(degC));
                      };
                      const double R = refraction(h * deg, air).in(deg);
                      if (!tally.finite(R, where)) return;
                      tally.law(R >= 0 && R < 2, where);
                      tally.law(h > -6 || R == 0, where);
                      const double lifted = higher + refraction(higher * deg, air).in(deg);
                      tally.error(h + R - lifted, where);
                    }});
  sweeps.push_back({"astro: lift_by_refraction", "rad off the angle of refraction()", 3e-16 * 8,
                    "unit vectors in double", 1, [](Draw& draw, Tally& tally) {
                      RefractionConditions air;
                      air.pressure = draw.in(0, 1100) * hPa;
                      const auto d = enu_direction(draw.in(0, 360) * deg, draw.in(-90, 90) * deg);
                      const auto where = [&] {
                        return fmt::format("({:.17g} {:.17g} {:.17g})", d.x(), d.y(), d.z());
                      };
                      const auto lifted = lift_by_refraction(d, air);
                      if (!tally.finite(lifted.x() + lifted.y() + lifted.z(), where)) return;
                      tally.law(off_unit(lifted) < 1e-15, where);
                      const double R = refraction(elevation(d), air).in(rad);
                      tally.error(std::abs(separation(d, lifted).in(rad)-R), where);
                    }});
  sweeps.push_back({"astro: flattening", "none", 0, "laws alone", 1, [](Draw& draw, Tally& tally) {
                      RefractionConditions air;
                      air.pressure = draw.in(0, 1100) * hPa;
                      air.temperature = draw.in(-90, 60) * degC;
                      const double h = draw.in(-90, 90), radius = draw.magnitude(1e-4, 1);
                      const auto where = [&] {
                        return fmt::format("h {:.17g} radius {:.17g} deg", h, radius);
                      };
                      const double value = flattening(h * deg, radius * deg, air);
                      if (tally.finite(value, where)) tally.law(value > 0 && value <= 1, where);
                    }});
}

}  // namespace

void add_sun_sweeps(std::vector<Sweep>& sweeps) {
  add_ephemerides(sweeps);
  add_geodesy(sweeps);
  add_refraction(sweeps);
}

}  // namespace skylapse::sweeps
