#include "sky/hosek_wilkie/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>

#include "data/cie1931.h"
#include "data/hosek_wilkie_rgb_pattern.h"
#include "data/hosek_wilkie_rgb_scale.h"
#include "data/hosek_wilkie_spectral_pattern.h"
#include "data/hosek_wilkie_spectral_scale.h"
#include "data/hosek_wilkie_xyz_pattern.h"
#include "data/hosek_wilkie_xyz_scale.h"

namespace skylapse::sky::hosek_wilkie {
namespace {

using ControlPoints = std::array<std::array<double, 9>, 6>;
using PatternTable = std::array<std::array<ControlPoints, 10>, 2>;        // [albedo][turbidity]
using ScaleTable = std::array<std::array<std::array<double, 6>, 10>, 2>;  // [albedo][turbidity]

/// Bernstein weights of degree 5 at u = cbrt(elevation / 90 deg): the paper's elevation axis.
std::array<double, 6> elevation_weights(Angle elevation) {
  const double u = std::cbrt(elevation / (90 * deg));
  const double v = 1 - u;
  return {v * v * v * v * v,      5 * v * v * v * v * u, 10 * v * v * v * u * u,
          10 * v * v * u * u * u, 5 * v * u * u * u * u, u * u * u * u * u};
}

struct Corner {
  int albedo, turbidity;  // table indices
  double weight;
};

/// Bilinear in albedo and turbidity. Turbidity 10 is a table entry with nothing above it: its
/// upper neighbour gets weight 0 on an entry that exists.
std::array<Corner, 4> corners(double turbidity, double albedo) {
  const int t = std::min(static_cast<int>(turbidity), 9);
  const double f = turbidity - t;
  return {Corner{0, t - 1, (1 - albedo) * (1 - f)}, Corner{0, t, (1 - albedo) * f},
          Corner{1, t - 1, albedo * (1 - f)}, Corner{1, t, albedo * f}};
}

Pattern interpolate(const PatternTable& patterns, const ScaleTable& scales,
                    const std::array<Corner, 4>& around, const std::array<double, 6>& control) {
  std::array<double, 9> p{};
  double scale = 0;
  for (const Corner& corner : around)
    for (size_t k = 0; k < control.size(); ++k) {
      const double w = corner.weight * control[k];
      for (size_t i = 0; i < p.size(); ++i)
        p[i] += w * patterns[corner.albedo][corner.turbidity][k][i];
      scale += w * scales[corner.albedo][corner.turbidity][k];
    }
  // The tables keep the original order, which has I before H.
  return {.a = p[0],
          .b = p[1],
          .c = p[2],
          .d = p[3],
          .e = p[4],
          .f = p[5],
          .g = p[6],
          .h = p[8],
          .i = p[7],
          .scale = scale};
}

/// Nothing if `value` is inside; NaN is outside.
std::optional<Error> outside(const char* name, double value, double low, double high,
                             const char* unit) {
  if (value >= low && value <= high) return std::nullopt;
  return Error{ErrorCode::invalid_input,
               fmt::format("Hosek-Wilkie sky: {} = {}{} is outside the model", name, value, unit),
               {},
               fmt::format("allowed: {} to {}{}", low, high, unit)};
}

}  // namespace

double horizon_gradient(const Pattern& p, double cos_theta) {
  return p.scale * (1 + p.a * std::exp(p.b / (cos_theta + 0.01)));
}

double lobes(const Pattern& p, Angle gamma, double cos_gamma) {
  const double cos2 = cos_gamma * cos_gamma;
  const double base = 1 + p.h * p.h - 2 * p.h * cos_gamma;
  const double chi = (1 + cos2) / (base * std::sqrt(base));
  return p.c + p.d * std::exp(p.e * gamma.in(rad)) + p.f * cos2 + p.g * chi;
}

double radiance(const Pattern& p, double cos_theta, Angle gamma) {
  const double mu = std::max(cos_theta, 0.0);
  return horizon_gradient(p, mu) * (lobes(p, gamma, cos(gamma)) + p.i * std::sqrt(mu));
}

double radiance(const Pattern& p, Angle theta, Angle gamma) {
  return radiance(p, cos(theta), gamma);
}

Result<Patterns> make_patterns(Fit fit, const SkyParameters& in) {
  const double elevation = in.sun_elevation.in(deg);
  if (auto error = outside("turbidity", in.turbidity, 1, 10, "")) return *error;
  if (auto error = outside("sun elevation", elevation, 0, 90, " deg")) return *error;
  Patterns out{.fit = fit, .count = fit == Fit::spectral ? kBandCount : 3};
  const std::array<double, 6> control = elevation_weights(in.sun_elevation);
  for (int n = 0; n < out.count; ++n) {
    if (auto error = outside("ground albedo", in.albedo[n], 0, 1, "")) return *error;
    const auto around = corners(in.turbidity, in.albedo[n]);
    switch (fit) {
      case Fit::spectral:
        out.items[n] = interpolate(data::kHosekWilkieSpectralPattern[n],
                                   data::kHosekWilkieSpectralScale[n], around, control);
        break;
      case Fit::xyz:
        out.items[n] = interpolate(data::kHosekWilkieXyzPattern[n], data::kHosekWilkieXyzScale[n],
                                   around, control);
        break;
      case Fit::rgb:
        out.items[n] = interpolate(data::kHosekWilkieRgbPattern[n], data::kHosekWilkieRgbScale[n],
                                   around, control);
        break;
    }
  }
  return out;
}

SpectralRadiance spectral_radiance(const Patterns& patterns, Wavelength wavelength, Angle theta,
                                   Angle gamma) {
  return spectral_radiance(patterns, wavelength, cos(theta), gamma);
}

SpectralRadiance spectral_radiance(const Patterns& patterns, Wavelength wavelength,
                                   double cos_theta, Angle gamma) {
  assert(patterns.fit == Fit::spectral);
  const double x = (wavelength.in(nm)-band_wavelength_nm(0)) / 40;
  assert(x >= 0 && x <= kBandCount - 1);
  const int i = std::min(static_cast<int>(x), kBandCount - 2);
  const double f = x - i;
  return ((1 - f) * radiance(patterns.items[i], cos_theta, gamma) +
          f * radiance(patterns.items[i + 1], cos_theta, gamma)) *
         W_per_m2_sr_nm;
}

std::array<double, 3> channel_albedo(Fit fit, const AlbedoSpectrum& albedo) {
  const auto& band = albedo.bands;
  if (fit == Fit::rgb)
    return {(band[7] + band[8] + band[9]) / 3, (band[5] + band[6]) / 2, (band[3] + band[4]) / 2};
  std::array<double, 3> sum{}, weight{};
  for (size_t k = 0; k < data::kCie1931.size(); ++k) {
    const double x = (data::kCie1931WavelengthNm[k] - band_wavelength_nm(0)) / 40;
    const int i = std::min(static_cast<int>(x + 0.5), kBandCount - 1);
    for (size_t c = 0; c < 3; ++c) {
      sum[c] += data::kCie1931[k][c] * band[i];
      weight[c] += data::kCie1931[k][c];
    }
  }
  return {sum[0] / weight[0], sum[1] / weight[1], sum[2] / weight[2]};
}

}  // namespace skylapse::sky::hosek_wilkie
