#include <chrono>
#include <cmath>

#include "astro/ephemeris/sun_formulas.h"

namespace skylapse::astro {
namespace {

using std::chrono::days;
using std::chrono::floor;
using std::chrono::microseconds;
using std::chrono::sys_days;
using std::numbers::pi;

struct SolarTime {
  double hours;  // t_s; 12 at noon
  double day_of_year;
};

/// Longitude in (-180, 180], so that +180 and -180 share one standard meridian and date.
double wrapped(double longitude_deg) {
  const double w = std::remainder(longitude_deg, 360.0);
  return w == -180 ? 180 : w;
}

SolarTime solar_time(const Instant& instant, double longitude_deg) {
  const double meridian_hours = std::round(longitude_deg / 15);
  const auto standard = instant.utc + std::chrono::hours{static_cast<int>(meridian_hours)};
  const sys_days date = floor<days>(standard);
  const sys_days new_year{std::chrono::year_month_day{date}.year() / 1 / 1};
  const double j = static_cast<double>((date - new_year).count() + 1);
  const double clock = static_cast<double>((standard - date).count()) / 3600e6;
  const double equation_of_time =
      0.170 * std::sin(4 * pi * (j - 80) / 373) - 0.129 * std::sin(2 * pi * (j - 8) / 355);
  const double from_meridian = longitude_deg / 15 - meridian_hours;
  return {.hours = clock + equation_of_time + from_meridian, .day_of_year = j};
}

}  // namespace

FormulaSun preetham_sun(const Instant& instant, const GeodeticPosition& observer,
                        AzimuthBranch branch) {
  const SolarTime t = solar_time(instant, wrapped(observer.longitude.in(deg)));
  const double declination = 0.4093 * std::sin(2 * pi * (t.day_of_year - 81) / 368);  // (3.3)
  const double sin_dec = std::sin(declination);
  const double cos_dec = std::cos(declination);
  const double sin_lat = sin(observer.latitude);
  const double cos_lat = cos(observer.latitude);
  const double angle = pi * t.hours / 12;
  const double up = sin_lat * sin_dec - cos_lat * cos_dec * std::cos(angle);  // (3.1)
  double west = -cos_dec * std::sin(angle);                                   // (3.2), numerator
  double south = -(cos_lat * sin_dec + sin_lat * cos_dec * std::cos(angle));  // and denominator
  if (branch == AzimuthBranch::half_circle && south < 0) {
    west = -west;  // arctan(west / south) cannot tell these from each other
    south = -south;
  }
  return {.direction = Direction<Enu>::from_vector({-west, -south, up}),
          .distance = 1.0 * astronomical_unit,  // the formulas say nothing of it
          .declination = declination * rad};
}

}  // namespace skylapse::astro
