#include "sky/cie/sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/constants.h"

namespace skylapse::sky::cie {
namespace {

/// One row of the standard.
struct Shape {
  double a, b;     // gradation 1 + a exp(b / cos z)
  double c, d, e;  // indicatrix 1 + c (exp(d chi) - exp(d pi / 2)) + e cos^2 chi
};
constexpr std::array<Shape, kTypes> kShapes{{{4, -0.7, 0, -1, 0},
                                             {4, -0.7, 2, -1.5, 0.15},
                                             {1.1, -0.8, 0, -1, 0},
                                             {1.1, -0.8, 2, -1.5, 0.15},
                                             {0, -1, 0, -1, 0},
                                             {0, -1, 2, -1.5, 0.15},
                                             {0, -1, 5, -2.5, 0.3},
                                             {0, -1, 10, -3, 0.45},
                                             {-1, -0.55, 2, -1.5, 0.15},
                                             {-1, -0.55, 5, -2.5, 0.3},
                                             {-1, -0.55, 10, -3, 0.45},
                                             {-1, -0.32, 10, -3, 0.45},
                                             {-1, -0.32, 16, -3, 0.3},
                                             {-1, -0.15, 16, -3, 0.3},
                                             {-1, -0.15, 24, -2.8, 0.15}}};

/// Share of the sun's horizontal illuminance above the air that a covered sky passes on.
constexpr std::array<double, 6> kCoveredShare{0.10, 0.18, 0.15, 0.22, 0.20, 0.38};

/// Of the zenith luminance of types 7 to 15.
struct ZenithFit {
  double a1, a2, c, d, turbidity;
};
constexpr std::array<ZenithFit, 9> kZenith{{{0.957, 1.790, 4.52, 0.64, 12},
                                            {0.830, 2.030, 4.94, 0.70, 10},
                                            {0.600, 1.500, 3.45, 0.50, 12},
                                            {0.567, 2.610, 4.27, 0.63, 10},
                                            {1.440, -0.750, 4.60, 0.72, 4},
                                            {1.036, 0.710, 4.43, 0.74, 2.5},
                                            {1.244, -0.840, 4.61, 0.76, 4.5},
                                            {0.881, 0.453, 4.40, 0.79, 5},
                                            {0.418, 1.950, 4.13, 0.79, 4}}};

constexpr double kSunKilolux = 133.8;  // luminous solar constant, CIE 110-1994
constexpr Angle kHighestFittedSun = 75 * deg;
/// x, y of the CIE standard illuminant D65, 2-degree observer (CIE 15:2004).
constexpr double kWhiteX = 0.31272, kWhiteY = 0.32903;

double gradation(const Shape& s, double cos_zenith) {
  return cos_zenith > 0 ? 1 + s.a * std::exp(s.b / cos_zenith) : 1;
}

double indicatrix(const Shape& s, double chi) {
  const double cosine = std::cos(chi);
  return 1 + s.c * (std::exp(s.d * chi) - std::exp(s.d * std::numbers::pi / 2)) +
         s.e * cosine * cosine;
}

const Shape& shape_of(int type) {
  assert(type >= 1 && type <= kTypes);
  return kShapes[size_t(type - 1)];
}

/// kcd/m^2, for a sun up to kHighestFittedSun.
double fitted_zenith(int type, double turbidity, Angle sun_elevation) {
  const ZenithFit& fit = kZenith[size_t(type - 7)];
  const double sine = sin(sun_elevation), cosine = cos(sun_elevation);
  return (fit.a1 * turbidity + fit.a2) * sine +
         0.7 * (turbidity + 1) * std::pow(sine, fit.c) / std::pow(cosine, fit.d) + 0.04 * turbidity;
}

}  // namespace

Status check(int type, double turbidity, Angle sun_elevation) {
  const auto refuse = [](std::string message, std::string hint) {
    return Error{ErrorCode::invalid_input, std::move(message), {}, std::move(hint)};
  };
  if (type < 1 || type > kTypes)
    return refuse(fmt::format("there is no CIE sky of type {}", type), "allowed: 1 to 15");
  if (!is_covered(type) && !(turbidity >= kLowestTurbidity && turbidity <= kHighestTurbidity))
    return refuse(fmt::format("turbidity {:.3g} is beyond the CIE general sky", turbidity),
                  fmt::format("allowed: {} to {}", kLowestTurbidity, kHighestTurbidity));
  if (!(sun_elevation >= 0 * deg && sun_elevation <= 90 * deg))
    return refuse(
        fmt::format("the sun at {:.3g} deg is beyond the CIE general sky", sun_elevation.in(deg)),
        "allowed: 0 to 90 deg of elevation");
  return Done{};
}

double typical_turbidity(int type) {
  assert(type > 6 && type <= kTypes);
  return kZenith[size_t(type - 7)].turbidity;
}

double relative_luminance(int type, double cos_zenith, Angle chi, Angle sun_zenith) {
  const Shape& s = shape_of(type);
  return indicatrix(s, chi.in(rad)) * gradation(s, cos_zenith) /
         (indicatrix(s, sun_zenith.in(rad)) * gradation(s, 1));
}

double illuminance_over_zenith(int type, Angle sun_zenith) {
  const Direction<Enu> sun = enu_direction(0 * deg, 90 * deg - sun_zenith);
  return dome_irradiance([&](const Direction<Enu>& view) {
           return glm::dvec3(relative_luminance(type, view.z(), separation(view, sun), sun_zenith));
         })
      .y;
}

Result<Luminance> zenith_luminance(int type, double turbidity, Angle sun_elevation) {
  const Status known = check(type, turbidity, sun_elevation);
  if (!known) return known.error();
  const auto kilocandela = [](double value) { return 1000 * value * cd_per_m2; };
  if (!is_covered(type) && sun_elevation <= kHighestFittedSun)
    return kilocandela(fitted_zenith(type, turbidity, sun_elevation));
  const auto of_share = [&](double share) {
    return share * kSunKilolux * sin(sun_elevation) /
           illuminance_over_zenith(type, 90 * deg - sun_elevation);
  };
  if (is_covered(type)) return kilocandela(of_share(kCoveredShare[size_t(type - 1)]));
  const double share = fitted_zenith(type, turbidity, kHighestFittedSun) *
                       illuminance_over_zenith(type, 90 * deg - kHighestFittedSun) /
                       (kSunKilolux * sin(kHighestFittedSun));
  return kilocandela(of_share(share));
}

double beam_transmittance(double turbidity, Angle elevation) {
  const double mass =
      1 / (sin(elevation) + 0.50572 * std::pow(elevation.in(deg) + 6.07995, -1.6364));
  return std::exp(-mass * turbidity / (9.9 + 0.043 * mass));
}

Result<FittedSky> make_sky(int type, double turbidity, const Direction<Enu>& sun,
                           Angle solar_radius) {
  if (!(solar_radius > 0 * deg && solar_radius <= 10 * deg))
    return Error{ErrorCode::invalid_input,
                 fmt::format("a sun of radius {:.3g} deg is beyond the CIE general sky",
                             solar_radius.in(deg)),
                 {},
                 "allowed: above 0, up to 10 deg"};
  const auto zenith = zenith_luminance(type, turbidity, elevation(sun));
  if (!zenith) return zenith.error();
  const Shape shape = shape_of(type);
  const double scale =
      zenith->in(cd_per_m2) / kLuminousEfficacy /
      (indicatrix(shape, (90 * deg - elevation(sun)).in(rad)) * gradation(shape, 1));
  const glm::dvec3 white(kWhiteX / kWhiteY, 1, (1 - kWhiteX - kWhiteY) / kWhiteY);
  FittedSky sky;
  sky.dome = [=](const Direction<Enu>& view) {
    return white *
           (scale * indicatrix(shape, separation(view, sun).in(rad)) * gradation(shape, view.z()));
  };
  sky.disc = dimmed_disc(sun, solar_radius, [=](Wavelength, Angle up) {
    return is_covered(type) ? 0 : beam_transmittance(turbidity, up);
  });
  return sky;
}

}  // namespace skylapse::sky::cie
