#include "sky/monte_carlo/optics.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace skylapse::sky::monte_carlo {

Optics::Optics(const atmosphere::Medium& medium, AerosolShape shape)
    : bands(int(medium.bands.size())),
      padded((bands + kernel::kLanes - 1) / kernel::kLanes * kernel::kLanes),
      shells(medium),
      rayleigh_phase(medium.rayleigh_depolarization),
      aerosol_phase(medium.aerosol_g, shape),
      sun_radius(medium.sun_angular_radius_rad),
      has_aerosol(false) {
  assert(bands >= 1 && bands <= kMaxBands);
  for (int i = 0; i < kMaxBands; ++i) {
    const atmosphere::SpectralBand& band = medium.bands[size_t(std::min(i, bands - 1))];
    const auto k = size_t(i);
    solar[k] = band.solar_irradiance;
    rayleigh[k] = band.rayleigh_scattering_per_km;
    aerosol[k] = band.aerosol_scattering_per_km;
    extinction_aerosol[k] = band.aerosol_extinction_per_km;
    ozone[k] = band.ozone_absorption_per_km;
    albedo[k] = band.ground_albedo;
    has_aerosol = has_aerosol || band.aerosol_scattering_per_km > 0;
  }
  for (size_t b = 0; b < size_t(bands); ++b) {
    mean_rayleigh += rayleigh[b] / bands;
    mean_aerosol += aerosol[b] / bands;
    mean_extinction_aerosol += extinction_aerosol[b] / bands;
    mean_ozone += ozone[b] / bands;
  }
  guide = SunGuide(*this);
}

void Optics::view_sun(double height, double mu_sun, SunVisibility rule, SunView& view) const {
  const double above = mu_sun - shells.horizon_cosine(height);
  if (rule == SunVisibility::disc) {
    view.visible = above > 0 ? 1 : 0;
  } else {
    // The disc's radius in units of the cosine, at the horizon.
    const double half = sun_radius * shells.radius() / (shells.radius() + height);
    const double x = half > 0 ? std::clamp((above + half) / (2 * half), 0.0, 1.0) : above > 0;
    view.visible = x * x * (3 - 2 * x);
  }
  if (view.visible > 0) transmittances(shells.to_top(height, mu_sun), view.transmittance);
}

double Optics::sun_on_ground(double height, double mu_sun, SunVisibility rule,
                             SunView& view) const {
  double cosine = std::max(mu_sun, 0.0);
  if (rule == SunVisibility::smooth_step && std::abs(mu_sun) < sun_radius)
    cosine = (mu_sun + sun_radius) * (mu_sun + sun_radius) / (4 * sun_radius);
  view.visible = cosine > 0 ? 1 : 0;
  if (cosine > 0) transmittances(shells.to_top(height, mu_sun), view.transmittance);
  return cosine;
}

}  // namespace skylapse::sky::monte_carlo
