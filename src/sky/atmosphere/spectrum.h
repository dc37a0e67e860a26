#pragma once
// A function of wavelength, given at nodes.
#include <vector>

#include "core/quantity.h"

namespace skylapse::sky::atmosphere {

/// Linear between its nodes, constant outside them. One node is a constant; none is 0.
struct Spectrum {
  std::vector<double> wavelength_nm;  // ascending
  std::vector<double> value;          // as many

  [[nodiscard]] double at(Wavelength wavelength) const;
  /// Mean over [from, to], exact for the piecewise linear function; at(from) if they are equal.
  [[nodiscard]] double mean(Wavelength from, Wavelength to) const;
};

Spectrum constant_spectrum(double value);

}  // namespace skylapse::sky::atmosphere
