#pragma once
// Reflectance of the ground, in the eleven bands of the Hosek-Wilkie sky.
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skylapse::sky {

inline constexpr int kBandCount = 11;
/// Centre of band `band`: 320, 360, ..., 720 nm.
constexpr double band_wavelength_nm(int band) { return 320.0 + 40.0 * band; }

/// Lambertian reflectance of the ground, each value in [0, 1].
struct AlbedoSpectrum {
  std::array<double, kBandCount> bands{};  // mean over +-20 nm about each band's centre
  double mean = 0;                         // over 400..700 nm
};

/// The same reflectance at all wavelengths.
AlbedoSpectrum grey_bands(double value);

/// Ground by name: a measured spectrum (grass, lawn, snow, soil-dry, soil-wet, water) or a grey
/// broadband value (urban, sand, asphalt, concrete, sea, fresh-snow, ...). Nothing if unknown.
/// Source: data/README.md for the spectra; broadband values as in pvlib's albedo table.
std::optional<AlbedoSpectrum> albedo_bands(std::string_view name);

/// All names that albedo_bands knows, sorted.
const std::vector<std::string>& ground_albedo_names();

}  // namespace skylapse::sky
