// SG2, notation of Blanc & Wald 2012: t counts days from 1980-01-01 00:00; f in 1/day, rho in
// radians, phi in radians.
#include <array>
#include <cmath>

#include "astro/ephemeris/sun_formulas.h"

namespace skylapse::astro {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;
constexpr double kJ2000From1980 = 7305.5;  // days

struct Harmonic {
  double period_days, rho, phi;
  [[nodiscard]] double at(double t) const { return rho * std::cos(kTwoPi * t / period_days - phi); }
};

/// Heliocentric longitude of the Earth: sum of these, plus t / 58.130101 + 1.742145 (section 4.1).
constexpr std::array<Harmonic, 10> kLongitude{{
    {365.261278, 3.401508e-2, 1.600780},
    {182.632412, 3.486440e-4, 1.662976},
    {29.530634, 3.136227e-5, -1.195905},
    {399.529850, 3.578979e-5, -1.042052},
    {291.956812, 2.676185e-5, 2.012613},
    {583.598201, 2.333925e-5, -2.867714},
    {4652.629372, 1.221214e-5, 1.225038},
    {1450.236684, 1.217941e-5, -0.828601},
    {199.459709, 1.343914e-5, -3.108253},
    {365.355291, 8.499475e-4, -2.353709},
}};
constexpr Harmonic kDistance{365.254902, 0.016704, -3.091159};      // au, about 1.000140
constexpr Harmonic kNutation{6791.164405, 8.329092e-5, -2.052757};  // in longitude
constexpr Harmonic kObliquity{6791.164405, 4.456183e-5, 2.660352};
constexpr double kAberration = -9.933735e-5;
constexpr double kParallax = 4.263521e-5;
constexpr double kEquatorRadiusM = 6378140.0;
constexpr double kFlattening = 1 / 298.257282697;

/// The sun on the equator of date, seen from the Earth's centre.
struct Geocentric {
  double right_ascension, sin_declination, cos_declination;
  double equation_of_equinoxes;
};

Geocentric geocentric_sun(double t) {
  double longitude = t / 58.130101 + 1.742145;
  for (const Harmonic& h : kLongitude) longitude += h.at(t);
  const double nutation = kNutation.at(t);
  const double obliquity = kObliquity.at(t) - 6.216374e-9 * t + 4.091383e-1;
  const double theta = longitude + std::numbers::pi + nutation + kAberration;
  const double x = std::cos(theta);
  const double y = std::sin(theta) * std::cos(obliquity);
  return {.right_ascension = std::atan2(y, x),
          .sin_declination = std::sin(theta) * std::sin(obliquity),
          .cos_declination = std::hypot(x, y),
          .equation_of_equinoxes = nutation * std::cos(obliquity)};
}

}  // namespace

FormulaSun sg2_sun(const AstronomicalTime& time, const GeodeticPosition& observer) {
  const double t = time.tt_days + kJ2000From1980;
  const Geocentric g = geocentric_sun(t);
  const double ut_days = time.ut1_whole_days + kJ2000From1980 + time.ut1_day_fraction;
  const double sidereal_time =
      std::fmod(6.300388099 * ut_days, kTwoPi) + 1.742079 + g.equation_of_equinoxes;
  const double hour_angle = sidereal_time + observer.longitude.in(rad)-g.right_ascension;

  const double sin_lat = sin(observer.latitude);
  const double cos_lat = cos(observer.latitude);
  const double reduced = std::atan2((1 - kFlattening) * sin_lat, cos_lat);
  const double height = observer.height.in(metre) / kEquatorRadiusM;
  const double x = std::cos(reduced) + height * cos_lat;
  const double y = (1 - kFlattening) * std::sin(reduced) + height * sin_lat;
  const double shift =
      -x * std::sin(hour_angle) / g.cos_declination * kParallax;  // of right ascension
  const double declination =
      std::atan2(g.sin_declination, g.cos_declination) +
      (x * std::cos(hour_angle) * g.sin_declination - y * g.cos_declination) * kParallax;
  const double h = hour_angle - shift;
  const double sin_dec = std::sin(declination);
  const double cos_dec = std::cos(declination);
  return {.direction = Direction<Enu>::from_vector(
              {-cos_dec * std::sin(h), cos_lat * sin_dec - sin_lat * cos_dec * std::cos(h),
               sin_lat * sin_dec + cos_lat * cos_dec * std::cos(h)}),
          .distance = (1.000140 + kDistance.at(t)) * astronomical_unit,
          .declination = atan2_angle(g.sin_declination, g.cos_declination)};
}

}  // namespace skylapse::astro
