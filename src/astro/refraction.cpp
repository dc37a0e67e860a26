#include "astro/refraction.h"

#include <algorithm>

namespace skylapse::astro {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;

/// Saemundsson's R in arcminutes at his standard air; `h` in degrees.
double standard_refraction_arcmin(double h) {
  return 1.02 / std::tan((h + 10.3 / (h + 5.11)) * kRadPerDeg);
}

/// dR/dh in arcminutes a degree.
double standard_slope(double h) {
  const double s = std::sin((h + 10.3 / (h + 5.11)) * kRadPerDeg);
  return -1.02 / (s * s) * kRadPerDeg * (1 - 10.3 / ((h + 5.11) * (h + 5.11)));
}

/// Cubic from (fade end, 0, slope 0) to (formula end, R, R').
double faded_refraction_arcmin(double h) {
  static const double top = kRefractionFormulaEnd.in(deg);
  static const double bottom = kRefractionFadeEnd.in(deg);
  static const double value = standard_refraction_arcmin(top);
  static const double slope = standard_slope(top);
  if (h <= bottom) return 0;
  const double width = top - bottom;
  const double u = (h - bottom) / width;
  return u * u * (value * (3 - 2 * u) + slope * width * (u - 1));
}

}  // namespace

Angle refraction(Angle true_elevation, const RefractionConditions& conditions) {
  if (!conditions.enabled) return {};
  const double pressure_hpa = conditions.pressure.in(hPa);
  const double temperature_c = conditions.temperature.in(degC);
  assert(pressure_hpa >= 0 && temperature_c > -273);
  const double h = true_elevation.in(deg);
  const double standard = h < kRefractionFormulaEnd.in(deg)
                              ? faded_refraction_arcmin(h)
                              : std::max(0.0, standard_refraction_arcmin(h));
  return standard * (pressure_hpa / 1010) * (283 / (273 + temperature_c)) * arcmin;
}

double flattening(Angle true_elevation, Angle radius, const RefractionConditions& conditions) {
  const Angle upper = refraction(true_elevation + radius, conditions);
  const Angle lower = refraction(true_elevation - radius, conditions);
  return std::min(1.0, 1 + (upper - lower) / (2 * radius));
}

Direction<Enu> lift_by_refraction(const Direction<Enu>& direction,
                                  const RefractionConditions& conditions) {
  const Angle lift = refraction(elevation(direction), conditions);
  const double horizontal = std::hypot(direction.x(), direction.y());
  if (lift == Angle{} || horizontal == 0) return direction;
  const double c = cos(lift);
  const double s = sin(lift);
  const double shrink = c - s * direction.z() / horizontal;
  return Direction<Enu>::from_vector(
      {direction.x() * shrink, direction.y() * shrink, direction.z() * c + horizontal * s});
}

}  // namespace skylapse::astro
