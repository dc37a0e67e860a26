#pragma once
// The air as a physicist would describe it: continuous spectra and profiles. medium_at() takes it
// to the bands that a renderer computes.
#include "core/constants.h"
#include "core/quantity.h"
#include "core/result.h"
#include "sky/atmosphere/medium.h"
#include "sky/atmosphere/spectrum.h"

namespace skylapse::sky::atmosphere {

struct Atmosphere {
  Length bottom_radius = kMeanEarthRadius;
  Length top_height = 100.0 * km;
  Angle sun_angular_radius = kSolarRadiusAt1Au;
  Spectrum solar_irradiance;     // W m^-2 nm^-1 at 1 au
  Spectrum rayleigh_scattering;  // per km where the Rayleigh density is 1
  DensityProfile rayleigh;
  double rayleigh_depolarization = 0.0279;
  Spectrum aerosol_extinction;  // per km where the aerosol density is 1
  Spectrum aerosol_single_scattering_albedo;
  DensityProfile aerosol;
  double aerosol_g = 0.7;
  Spectrum ozone_absorption;  // per km where the ozone density is 1
  DensityProfile ozone;
  Spectrum ground_albedo;
};

/// Edges of `bands` (1..64) bins that cover 360..830 nm, narrow where eye and sun make them count.
std::vector<Wavelength> band_edges(int bands);

/// Means over each bin: solar irradiance by wavelength, everything else weighted by what sun and
/// eye make of each wavelength; xyz_weight (0 or more) such that a radiance proportional to the
/// sun's spectrum has the XYZ of the whole spectrum.
Medium medium_at(const Atmosphere& atmosphere, const std::vector<Wavelength>& edges);
/// Samples at wavelengths instead of means; xyz_weight is 0.
Medium medium_sampled(const Atmosphere& atmosphere, const std::vector<Wavelength>& wavelengths);

/// Air thicker than this is refused: no light that matters comes through.
inline constexpr double kMaxAerosolOpticalDepth = 100;

/// What a user says about the air, all at 550 nm where a wavelength matters.
struct AirDescription {
  double aerosol_optical_depth = 0.1;  // vertical, 0 to kMaxAerosolOpticalDepth
  double angstrom_exponent = 1.3;
  double aerosol_single_scattering_albedo = 0.92;
  double aerosol_g = 0.7;  // shape parameter of Cornette-Shanks
  Length aerosol_scale_height = 1.2 * km;
  double stratospheric_optical_depth = 0;  // a volcano's layer, tent between the heights below
  Length stratospheric_bottom = 15.0 * km, stratospheric_top = 25.0 * km;
  double ozone_du = 300;  // Dobson units
  Pressure surface_pressure{1013.25, hPa};
  Length planet_radius = kMeanEarthRadius;
  Length top_height = 100.0 * km;
  Spectrum ground_albedo;  // empty: grey 0.2
};

/// The atmosphere of a description; refuses nonsense with the name of the value and its range.
Result<Atmosphere> atmosphere_of(const AirDescription& air);

}  // namespace skylapse::sky::atmosphere
