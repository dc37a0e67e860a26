#include "sky/atmosphere_disc.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace skylapse::sky {

double limb_darkening_exponent(Wavelength wavelength) {
  const auto ultraviolet = [](double um) { return -0.507 + 0.441 / um; };
  const auto visible = [](double um) { return -0.023 + 0.292 / um; };
  constexpr double kUltravioletEnd = 0.372, kVisibleBegin = 0.416;
  const double um = std::clamp(1e-3 * wavelength.in(nm), 0.303, 1.1);
  if (um <= kUltravioletEnd) return ultraviolet(um);
  if (um >= kVisibleBegin) return visible(um);
  return std::lerp(ultraviolet(kUltravioletEnd), visible(kVisibleBegin),
                   (um - kUltravioletEnd) / (kVisibleBegin - kUltravioletEnd));
}

double limb_darkening_mean(double exponent) { return 2 / (exponent + 2); }

AtmosphereDisc::AtmosphereDisc(const atmosphere::Medium& medium, Angle radius, Angle lowest,
                               Angle step, const std::vector<std::vector<double>>& transmittance)
    : lowest_rad_(lowest.in(rad)), step_rad_(step.in(rad)), elevations_(int(transmittance.size())) {
  assert(elevations_ >= 2 && step > Angle{} && radius > Angle{});
  const double solid_angle = std::numbers::pi * sin(radius) * sin(radius);
  std::vector<glm::dvec3> unattenuated;
  for (const atmosphere::SpectralBand& band : medium.bands) {
    exponents_.push_back(limb_darkening_exponent(band.wavelength_nm * nm));
    unattenuated.push_back(band.xyz_weight * band.solar_irradiance /
                           (solid_angle * limb_darkening_mean(exponents_.back())));
  }
  for (const auto& at_elevation : transmittance) {
    assert(at_elevation.size() == medium.bands.size());
    for (size_t b = 0; b < at_elevation.size(); ++b)
      colours_.push_back(at_elevation[b] * unattenuated[b]);
  }
}

glm::dvec3 AtmosphereDisc::radiance_xyz(Angle view_elevation, double limb_m) const {
  const double place =
      std::clamp((view_elevation.in(rad)-lowest_rad_) / step_rad_, 0.0, double(elevations_ - 1));
  const int i = std::min(int(place), elevations_ - 2);
  const double f = place - i;
  const size_t bands = exponents_.size();
  const glm::dvec3 *low = colours_.data() + i * bands, *high = low + bands;
  const double log_m = std::log(std::max(limb_m, 1e-30));
  glm::dvec3 sum(0);
  for (size_t b = 0; b < bands; ++b)
    sum += std::exp(exponents_[b] * log_m) * (low[b] + f * (high[b] - low[b]));
  return sum;
}

}  // namespace skylapse::sky
