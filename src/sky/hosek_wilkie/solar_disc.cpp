#include "sky/hosek_wilkie/solar_disc.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "data/cie1931.h"
#include "data/hosek_wilkie_limb_darkening.h"
#include "data/hosek_wilkie_solar.h"
#include "sky/quadrature.h"

namespace skylapse::sky::hosek_wilkie {
namespace {

constexpr int kPieces = 45;

/// Band below a wavelength and the share of the band above it.
struct BandPosition {
  int band;
  double upper;
};

BandPosition band_position(double wavelength_nm) {
  const double x = (wavelength_nm - band_wavelength_nm(0)) / 40;
  const int band = std::clamp(static_cast<int>(x), 0, kBandCount - 2);
  return {band, std::clamp(x - band, 0.0, 1.0)};
}

/// Mean of the limb darkening over the disc: integral of l(m) 2 m dm, per band.
std::array<double, kBandCount> limb_means() {
  std::array<double, kBandCount> means{};
  for (int band = 0; band < kBandCount; ++band)
    for (int n = 0; n < 6; ++n)
      means[band] += 2.0 / (n + 2) * data::kHosekWilkieLimbDarkening[band][n];
  return means;
}

double flux_divisor(SolarFlux flux, BandPosition at) {
  if (flux == SolarFlux::reference) return 1.0;
  static const std::array<double, kBandCount> means = limb_means();
  return (1 - at.upper) * means[at.band] + at.upper * means[at.band + 1];
}

}  // namespace

Result<SolarDisc> SolarDisc::make(double turbidity, SolarFlux flux, Angle radius) {
  if (!(turbidity >= 1 && turbidity <= 10))
    return Error{ErrorCode::invalid_input,
                 fmt::format("solar disc: turbidity = {} is outside the model", turbidity),
                 {},
                 "allowed: 1 to 10"};
  if (!(radius > 0 * deg && radius < 90 * deg))
    return Error{ErrorCode::invalid_input,
                 fmt::format("solar disc: radius = {} deg is not a disc", radius.in(deg)),
                 {},
                 "allowed: above 0, below 90 deg"};
  SolarDisc disc;
  disc.radius_ = radius;
  disc.flux_ = flux;
  const double ratio = sin(kReferenceSolarRadius) / sin(radius);
  disc.radius_factor_ = ratio * ratio;

  const int t = std::min(static_cast<int>(turbidity), 9);
  const double f = turbidity - t;
  for (int band = 0; band < kBandCount; ++band)
    for (int piece = 0; piece < kPieces; ++piece)
      for (int k = 0; k < 4; ++k)
        disc.pieces_[band][piece][k] =
            disc.radius_factor_ * ((1 - f) * data::kHosekWilkieSolar[band][t - 1][piece][k] +
                                   f * data::kHosekWilkieSolar[band][t][piece][k]);

  for (size_t n = 0; n < data::kCie1931.size(); ++n) {
    // Beyond 720 nm the model ends; its last value is held (see Sky).
    const BandPosition at = band_position(data::kCie1931WavelengthNm[n]);
    const auto& cmf = data::kCie1931[n];
    const glm::dvec3 weight = glm::dvec3(cmf[0], cmf[1], cmf[2]) / flux_divisor(flux, at);
    disc.same_band_[at.band] += (1 - at.upper) * (1 - at.upper) * weight;
    disc.same_band_[at.band + 1] += at.upper * at.upper * weight;
    disc.next_band_[at.band] += at.upper * (1 - at.upper) * weight;
  }
  return disc;
}

std::optional<double> SolarDisc::limb_variable(Angle gamma) const {
  // sin gamma alone would show a second sun at the antisolar point.
  if (!(gamma < 90 * deg)) return std::nullopt;
  const double ratio = sin(gamma) / sin(radius_);
  const double squared = 1 - ratio * ratio;
  if (squared <= 0) return std::nullopt;
  return std::sqrt(squared);
}

SolarDisc::Bands SolarDisc::unlimbed_bands(Angle view_elevation) const {
  Bands bands{};
  const double el = view_elevation.in(rad);
  constexpr double kQuarter = std::numbers::pi / 2;
  if (!(el >= 0)) return bands;
  const int piece = std::min(static_cast<int>(kPieces * std::cbrt(el / kQuarter)), kPieces - 1);
  const double start = static_cast<double>(piece) / kPieces;
  const double d = el - kQuarter * start * start * start;
  for (int band = 0; band < kBandCount; ++band) {
    const auto& k = pieces_[band][piece];
    bands[band] = ((k[0] * d + k[1]) * d + k[2]) * d + k[3];
  }
  return bands;
}

SolarDisc::Bands SolarDisc::limb_bands(double limb) {
  Bands bands{};
  for (int band = 0; band < kBandCount; ++band) {
    const auto& a = data::kHosekWilkieLimbDarkening[band];
    bands[band] =
        ((((a[5] * limb + a[4]) * limb + a[3]) * limb + a[2]) * limb + a[1]) * limb + a[0];
  }
  return bands;
}

SpectralRadiance SolarDisc::radiance(Wavelength wavelength, Angle view_elevation,
                                     double limb) const {
  assert(wavelength >= 320 * nm && wavelength <= 720 * nm && limb >= 0 && limb <= 1);
  const BandPosition at = band_position(wavelength.in(nm));
  const Bands s = unlimbed_bands(view_elevation);
  const Bands l = limb_bands(limb);
  const double f = at.upper;
  const double value = ((1 - f) * s[at.band] + f * s[at.band + 1]) *
                       ((1 - f) * l[at.band] + f * l[at.band + 1]) / flux_divisor(flux_, at);
  return value * W_per_m2_sr_nm;
}

glm::dvec3 SolarDisc::radiance_xyz(Angle view_elevation, double limb) const {
  const Bands s = unlimbed_bands(view_elevation);
  const Bands l = limb_bands(limb);
  glm::dvec3 xyz(0);
  for (int i = 0; i < kBandCount; ++i) xyz += s[i] * l[i] * same_band_[i];
  for (int i = 0; i + 1 < kBandCount; ++i)
    xyz += (s[i] * l[i + 1] + s[i + 1] * l[i]) * next_band_[i];
  return xyz;
}

SolarDisc::Irradiance SolarDisc::irradiance(Angle sun_elevation) const {
  static const auto rings = gauss_legendre<12>();
  static const auto arcs = gauss_legendre<24>();
  static const auto sums = limb_means();
  Irradiance total;
  const double sin_r = sin(radius_), sin_e = sin(sun_elevation), cos_e = cos(sun_elevation);

  // One ring of the disc: limb variable m, share dm of the radius axis.
  auto add_ring = [&](double m, double dm) {
    const double sin_g = sin_r * std::sqrt(1 - m * m), cos_g = std::sqrt(1 - sin_g * sin_g);
    // Above the horizon where cos phi >= -tan e / tan gamma, phi counted from the upper limb.
    const double edge = std::clamp(-sin_e * cos_g / (cos_e * sin_g), -1.0, 1.0);
    const double half_arc = std::acos(edge);
    const Bands limb = limb_bands(m);
    for (const auto& [x, weight] : arcs) {
      const double sin_el = sin_e * cos_g + cos_e * sin_g * std::cos(x * half_arc);
      const Angle el = std::asin(std::clamp(sin_el, 0.0, 1.0)) * rad;
      const double omega = sin_r * sin_r * m * dm / cos_g * 2 * half_arc * weight;
      const glm::dvec3 xyz = omega * radiance_xyz(el, m);
      total.normal_xyz += cos_g * xyz;
      total.horizontal_xyz += sin_el * xyz;
      const Bands s = unlimbed_bands(el);
      for (int b = 0; b < kBandCount; ++b)
        total.horizontal_bands[b] +=
            sin_el * omega * s[b] * limb[b] / (flux_ == SolarFlux::conserving ? sums[b] : 1.0);
    }
  };
  auto add_range = [&](double from, double to) {
    for (const auto& [x, weight] : rings) add_ring(from + (to - from) * x, (to - from) * weight);
  };

  // Rings wider than |e| meet the horizon: split there, because the arc has a kink.
  const double ratio = std::abs(sin_e) / sin_r;
  if (sun_elevation < 0 * deg && ratio >= 1) return total;
  const double cut = ratio < 1 ? std::sqrt(1 - ratio * ratio) : 0.0;
  if (cut > 0) add_range(0, cut);
  if (cut < 1 && sun_elevation > 0 * deg) add_range(cut, 1);
  return total;
}

}  // namespace skylapse::sky::hosek_wilkie
