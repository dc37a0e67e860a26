#include "sky/hosek_wilkie/sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "color/cie_observer.h"
#include "color/rgb_space.h"
#include "sky/quadrature.h"

namespace skylapse::sky::hosek_wilkie {
namespace {

/// The bands are points of a spectrum that is straight between them.
std::array<glm::dvec3, kBandCount> spectral_weights() {
  std::array<Wavelength, kBandCount> nodes;
  for (int band = 0; band < kBandCount; ++band) nodes[band] = band_wavelength_nm(band) * nm;
  std::array<glm::dvec3, kBandCount> weights;
  std::ranges::copy(color::xyz_weights(nodes), weights.begin());
  return weights;
}

std::array<glm::dvec3, kBandCount> weights_of(Fit fit) {
  if (fit == Fit::spectral) {
    static const auto weights = spectral_weights();
    return weights;
  }
  const glm::dmat3 to_xyz =
      fit == Fit::xyz ? glm::dmat3(1.0) : color::rgb_to_xyz(color::RgbSpace::rec709);
  return {to_xyz[0], to_xyz[1], to_xyz[2]};
}

double cos_zenith(const Direction<Enu>& view) { return std::max(view.z(), 0.0); }

}  // namespace

Sky::Sky(Patterns patterns, SolarDisc disc, const AlbedoSpectrum& albedo, Angle sun_elevation)
    : patterns_(std::move(patterns)),
      xyz_weights_(weights_of(patterns_.fit)),
      disc_(std::move(disc)),
      albedo_(albedo),
      sun_elevation_(sun_elevation) {}

Result<Sky> Sky::make(Fit fit, SolarFlux flux, double turbidity, const AlbedoSpectrum& albedo,
                      Angle sun_elevation, Angle solar_radius) {
  SkyParameters parameters{turbidity, albedo.bands, sun_elevation};
  if (fit != Fit::spectral) {
    const auto channels = channel_albedo(fit, albedo);
    std::copy(channels.begin(), channels.end(), parameters.albedo.begin());
  }
  Result<Patterns> patterns = make_patterns(fit, parameters);
  if (!patterns) return patterns.error();
  Result<SolarDisc> disc = SolarDisc::make(turbidity, flux, solar_radius);
  if (!disc) return disc.error();
  return Sky(*std::move(patterns), *std::move(disc), albedo, sun_elevation);
}

glm::dvec3 Sky::radiance_xyz(const Direction<Enu>& view, const Direction<Enu>& sun) const {
  const Angle gamma = separation(view, sun);
  const double cos_gamma = cos(gamma), mu = cos_zenith(view), w = std::sqrt(mu);
  glm::dvec3 xyz(0);
  for (int n = 0; n < patterns_.count; ++n) {
    const Pattern& p = patterns_.items[n];
    xyz += horizon_gradient(p, mu) * (lobes(p, gamma, cos_gamma) + p.i * w) * xyz_weights_[n];
  }
  return xyz;
}

SpectralRadiance Sky::spectral_radiance(Wavelength wavelength, const Direction<Enu>& view,
                                        const Direction<Enu>& sun) const {
  return hosek_wilkie::spectral_radiance(patterns_, wavelength, cos_zenith(view),
                                         separation(view, sun));
}

std::array<double, kBandCount> Sky::diffuse_irradiance_items() const {
  // mu = w^2 takes the root and most of the horizon's gradient out of the integrand:
  // E = integral of L mu dmu dphi = integral of L 2 w^3 dw dphi.
  static const auto zenith = gauss_legendre<48>();
  static const auto azimuth = gauss_legendre<48>();
  std::array<double, kBandCount> sum{};
  const double sin_s = sin(sun_elevation_), cos_s = cos(sun_elevation_);
  for (const auto& [w, zenith_weight] : zenith) {
    const double mu = w * w, sine = std::sqrt(1 - mu * mu);
    std::array<double, kBandCount> ring{};
    for (const auto& [x, azimuth_weight] : azimuth) {
      // phi = pi x^2 puts half of the points within 45 deg of the sun, where the sky is steep.
      const double phi = std::numbers::pi * x * x;
      const glm::dvec3 view(sine * std::cos(phi), sine * std::sin(phi), mu);
      const glm::dvec3 sun(cos_s, 0, sin_s);
      const glm::dvec3 cross = glm::cross(view, sun);
      const Angle gamma = atan2_angle(std::sqrt(glm::dot(cross, cross)), glm::dot(view, sun));
      const double weight = azimuth_weight * 4 * std::numbers::pi * x;
      for (int n = 0; n < patterns_.count; ++n)
        ring[n] += weight * lobes(patterns_.items[n], gamma, cos(gamma));
    }
    for (int n = 0; n < patterns_.count; ++n) {
      const Pattern& p = patterns_.items[n];
      sum[n] += zenith_weight * 2 * w * mu * horizon_gradient(p, mu) *
                (ring[n] + 2 * std::numbers::pi * p.i * w);
    }
  }
  return sum;
}

glm::dvec3 Sky::diffuse_irradiance_xyz() const {
  const auto items = diffuse_irradiance_items();
  glm::dvec3 xyz(0);
  for (int n = 0; n < patterns_.count; ++n) xyz += items[n] * xyz_weights_[n];
  return xyz;
}

SolarDisc::Irradiance Sky::direct_irradiance() const { return disc_.irradiance(sun_elevation_); }

glm::dvec3 Sky::ground_radiance_xyz() const {
  const auto sky = diffuse_irradiance_items();
  const auto sun = direct_irradiance().horizontal_bands;
  const auto band_weights = weights_of(Fit::spectral);
  glm::dvec3 xyz(0);
  for (int b = 0; b < kBandCount; ++b) xyz += albedo_.bands[b] * sun[b] * band_weights[b];
  const auto channels = channel_albedo(patterns_.fit, albedo_);
  for (int n = 0; n < patterns_.count; ++n)
    xyz += (fit() == Fit::spectral ? albedo_.bands[n] : channels[n]) * sky[n] * xyz_weights_[n];
  return xyz / std::numbers::pi;
}

}  // namespace skylapse::sky::hosek_wilkie
