#pragma once
// The spectra of data/ as functions of wavelength.
#include <optional>
#include <string_view>

#include "sky/atmosphere/spectrum.h"

namespace skylapse::sky::atmosphere {

/// Sunlight above the atmosphere at 1 au [W m^-2 nm^-1], 280..1000 nm.
Spectrum solar_irradiance_spectrum();
/// Vertical optical depth of the air's molecules at 1013.25 hPa, 300..830 nm.
Spectrum rayleigh_optical_depth_spectrum();
/// Depolarization of their scattering at 550 nm, taken for all wavelengths (0.0286 at 500 nm,
/// 0.0279 at 680 nm).
double rayleigh_depolarization();
/// Vertical optical depth of one Dobson unit of ozone, 300..829 nm.
Spectrum ozone_optical_depth_spectrum();
/// Reflectance of a ground by its name (sky/ground_albedo.h); nothing if unknown.
std::optional<Spectrum> ground_albedo_spectrum(std::string_view name);

}  // namespace skylapse::sky::atmosphere
