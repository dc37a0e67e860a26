#pragma once
// From spectra to CIE XYZ with the 1931 2-degree observer.
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "color/rgb_space.h"
#include "core/quantity.h"

namespace skylapse::color {

/// Weights w_i with XYZ = sum of w_i * L_i, for a spectrum L given at the wavelengths `nodes`
/// (ascending, at least one; asserted), straight between them and held beyond the first and last.
/// The sum runs over the 1 nm table from 360 to 830 nm. With L in W m^-2 sr^-1 nm^-1, 683 Y is
/// cd/m^2; no normalisation enters.
std::vector<glm::dvec3> xyz_weights(std::span<const Wavelength> nodes);

/// XYZ of a spectrum given at `nodes` (same size as `values`; asserted).
Color<Xyz> xyz_of_spectrum(std::span<const Wavelength> nodes, std::span<const double> values);

}  // namespace skylapse::color
