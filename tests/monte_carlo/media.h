#pragma once
// Media of which laws are known.
#include "sky/atmosphere/medium.h"

namespace skylapse::sky::monte_carlo {

inline atmosphere::SpectralBand unit_band() {
  return {.wavelength_nm = 550, .solar_irradiance = 1};
}

/// A homogeneous layer 1 km thick on a sphere so large that it is flat (its horizon dips by 0.08
/// deg), of molecules of vertical optical depth `depth`, without absorption, over `albedo`.
inline atmosphere::Medium slab(double depth, double albedo) {
  atmosphere::Medium medium;
  medium.bottom_radius_km = 1e6;
  medium.top_height_km = 1;
  medium.sun_angular_radius_rad = 1e-6;
  medium.rayleigh.terms = {{.top_km = 1, .constant = 1}};
  medium.bands = {unit_band()};
  medium.bands[0].rayleigh_scattering_per_km = depth;
  medium.bands[0].ground_albedo = albedo;
  return medium;
}

/// A layer 1 km thick of droplets that only scatter, over a black ground.
inline atmosphere::Medium cloud(double depth) {
  atmosphere::Medium medium = slab(0, 0);
  medium.aerosol.terms = {{.top_km = 1, .constant = 1}};
  medium.aerosol_g = 0.85;
  medium.bands[0].aerosol_scattering_per_km = medium.bands[0].aerosol_extinction_per_km = depth;
  return medium;
}

/// The reference medium without absorption: ozone gone, aerosol only scatters.
inline atmosphere::Medium conservative(double albedo) {
  atmosphere::Medium medium = atmosphere::reference_medium();
  for (atmosphere::SpectralBand& band : medium.bands) {
    band.aerosol_extinction_per_km = band.aerosol_scattering_per_km;
    band.ozone_absorption_per_km = 0;
    band.ground_albedo = albedo;
    band.solar_irradiance = 1;
  }
  return medium;
}

}  // namespace skylapse::sky::monte_carlo
