#pragma once
// The atmosphere at a set of wavelengths: what the transport of light needs, and nothing else.
// Lengths in km, coefficients per km, so that float keeps its digits on the GPU.
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/result.h"
#include "sky/atmosphere/density_profile.h"

namespace skylapse::sky::atmosphere {

/// The coefficients of one wavelength, or the means over one bin of wavelengths.
struct SpectralBand {
  double wavelength_nm = 0;               // the solar-weighted middle of the bin
  double solar_irradiance = 0;            // W m^-2 nm^-1 at 1 au, above the atmosphere
  double rayleigh_scattering_per_km = 0;  // where the Rayleigh density is 1
  double aerosol_scattering_per_km = 0;   // where the aerosol density is 1
  double aerosol_extinction_per_km = 0;   // scattering + absorption
  double ozone_absorption_per_km = 0;     // where the ozone density is 1
  double ground_albedo = 0;               // Lambert, 0..1
  /// CIE weights: XYZ = sum over bands of radiance * xyz_weight [nm]; radiance W m^-2 sr^-1 nm^-1
  /// gives W m^-2 sr^-1 in CIE's weighting (1.0 of Y is 683 cd/m^2).
  glm::dvec3 xyz_weight{0};
};

/// Two radii, three components, a ground. Plain values: two equal media give equal pictures.
struct Medium {
  double bottom_radius_km = 6360;
  double top_height_km = 60;  // no air above
  double sun_angular_radius_rad = 0.00465;
  DensityProfile rayleigh, aerosol, ozone;
  double rayleigh_depolarization = 0;  // rho of King 1923; 0 is the plain 3/(16 pi) (1 + nu^2)
  double aerosol_g = 0.8;              // shape parameter of Cornette-Shanks, in (-1, 1)
  std::vector<SpectralBand> bands;     // 1..64
};

/// Refuses what is no atmosphere: NaN, negative coefficients, albedo outside 0..1, |g| >= 1,
/// scattering above extinction, top at or below the ground, no bands. The message names the value
/// and what is allowed.
Status check(const Medium& medium);

/// Stable text of every number in the medium (hexadecimal floats): equal if and only if the media
/// are. Tables are kept under its hash.
std::string canonical_text(const Medium& medium);

/// The medium of Bruneton's demo at 680, 550 and 440 nm (ebruneton/precomputed_atmospheric_
/// scattering, demo.cc, BSD-3): 6360..6420 km, Rayleigh 8 km, aerosol 1.2 km with g 0.8, ozone
/// tent at 25 km, ground 0.1. Published truth and comparisons use it; xyz_weight is 0.
Medium reference_medium();

}  // namespace skylapse::sky::atmosphere
