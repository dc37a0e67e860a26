#include "sky/preetham/sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/constants.h"
#include "sky/atmosphere/input_spectra.h"

namespace skylapse::sky::preetham {
namespace {

constexpr double kLeastCosine = 1e-3;  // B / cos(theta) is finite; the horizon's limit is reached
constexpr double kOzoneDu = 300;

/// A cubic in the sun's zenith angle, highest power first.
double cubic(const double (&k)[4], double t) { return ((k[0] * t + k[1]) * t + k[2]) * t + k[3]; }

Xyy zenith_of(double turbidity, double sun_zenith) {
  constexpr double kX[3][4] = {{0.00166, -0.00375, 0.00209, 0},
                               {-0.02903, 0.06377, -0.03202, 0.00394},
                               {0.11693, -0.21196, 0.06052, 0.25886}};
  constexpr double kY[3][4] = {{0.00275, -0.00610, 0.00317, 0},
                               {-0.04214, 0.08970, -0.04153, 0.00516},
                               {0.15346, -0.26756, 0.06670, 0.26688}};
  const auto chromaticity = [&](const double(&k)[3][4]) {
    return (cubic(k[0], sun_zenith) * turbidity + cubic(k[1], sun_zenith)) * turbidity +
           cubic(k[2], sun_zenith);
  };
  const double chi = (4.0 / 9 - turbidity / 120) * (std::numbers::pi - 2 * sun_zenith);
  return {chromaticity(kX), chromaticity(kY),
          (4.0453 * turbidity - 4.9710) * std::tan(chi) - 0.2155 * turbidity + 2.4192};
}

/// The relative optical mass of the paper, after Kasten 1966.
double optical_mass(Angle elevation) {
  const double zenith_deg = 90 - elevation.in(deg);
  return 1 / (sin(elevation) + 0.15 * std::pow(93.885 - zenith_deg, -1.253));
}

}  // namespace

double Model::Perez::at(double cos_zenith, double gamma) const {
  const double cosine = std::cos(gamma);
  return (1 + a * std::exp(b / cos_zenith)) * (1 + c * std::exp(d * gamma) + e * cosine * cosine);
}

Result<Model> Model::make(double turbidity, Angle sun_elevation) {
  if (!(turbidity >= kLowestTurbidity && turbidity <= kHighestTurbidity))
    return Error{ErrorCode::invalid_input,
                 fmt::format("turbidity {:.3g} is beyond the Preetham sky", turbidity),
                 {},
                 fmt::format("allowed: {} to {}", kLowestTurbidity, kHighestTurbidity)};
  if (!(sun_elevation >= 0 * deg && sun_elevation <= 90 * deg))
    return Error{
        ErrorCode::invalid_input,
        fmt::format("the sun at {:.3g} deg is beyond the Preetham sky", sun_elevation.in(deg)),
        {},
        "allowed: 0 to 90 deg of elevation"};
  const double t = turbidity, zenith = (90 * deg - sun_elevation).in(rad);
  Model model;
  model.luminance_ = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251,
                      0.1206 * t - 2.5771, -0.0670 * t + 0.3703};
  model.x_ = {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125,
              -0.0641 * t - 0.8989, -0.0033 * t + 0.0452};
  model.y_ = {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102,
              -0.0441 * t - 1.6537, -0.0109 * t + 0.0529};
  model.zenith_ = zenith_of(t, zenith);
  model.scale_ = {model.zenith_.x / model.x_.at(1, zenith),
                  model.zenith_.y / model.y_.at(1, zenith),
                  model.zenith_.luminance / model.luminance_.at(1, zenith)};
  return model;
}

Xyy Model::at(double cos_zenith, Angle gamma) const {
  const double cosine = std::max(cos_zenith, kLeastCosine), angle = gamma.in(rad);
  return {scale_.x * x_.at(cosine, angle), scale_.y * y_.at(cosine, angle),
          scale_.luminance * luminance_.at(cosine, angle)};
}

double beam_transmittance(double turbidity, Wavelength wavelength, Angle elevation) {
  static const atmosphere::Spectrum ozone = atmosphere::ozone_optical_depth_spectrum();
  const double um = wavelength.in(nm) / 1000;
  const double beta = std::max(0.0, 0.04608 * turbidity - 0.04586);
  const double depth =
      0.008735 * std::pow(um, -4.08) + beta * std::pow(um, -1.3) + kOzoneDu * ozone.at(wavelength);
  return std::exp(-depth * optical_mass(elevation));
}

Result<FittedSky> make_sky(double turbidity, const Direction<Enu>& sun, Angle solar_radius) {
  if (!(solar_radius > 0 * deg && solar_radius <= 10 * deg))
    return Error{
        ErrorCode::invalid_input,
        fmt::format("a sun of radius {:.3g} deg is beyond the Preetham sky", solar_radius.in(deg)),
        {},
        "allowed: above 0, up to 10 deg"};
  auto made = Model::make(turbidity, elevation(sun));
  if (!made) return made.error();
  FittedSky sky;
  sky.dome = [model = *made, sun](const Direction<Enu>& view) {
    const Xyy c = model.at(view.z(), separation(view, sun));
    const double luminance = 1000 * c.luminance / kLuminousEfficacy;
    return glm::dvec3(c.x / c.y, 1, (1 - c.x - c.y) / c.y) * luminance;
  };
  sky.disc = dimmed_disc(sun, solar_radius, [=](Wavelength wavelength, Angle up) {
    return beam_transmittance(turbidity, wavelength, up);
  });
  return sky;
}

}  // namespace skylapse::sky::preetham
