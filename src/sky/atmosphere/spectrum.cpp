#include "sky/atmosphere/spectrum.h"

#include <algorithm>

namespace skylapse::sky::atmosphere {

double Spectrum::at(Wavelength wavelength) const {
  if (value.empty()) return 0;
  const double x = wavelength.in(nm);
  if (x <= wavelength_nm.front()) return value.front();
  if (x >= wavelength_nm.back()) return value.back();
  const auto above = std::upper_bound(wavelength_nm.begin(), wavelength_nm.end(), x);
  const size_t i = static_cast<size_t>(above - wavelength_nm.begin()) - 1;
  const double f = (x - wavelength_nm[i]) / (wavelength_nm[i + 1] - wavelength_nm[i]);
  return (1 - f) * value[i] + f * value[i + 1];
}

double Spectrum::mean(Wavelength from, Wavelength to) const {
  const double a = from.in(nm), b = to.in(nm);
  if (a == b) return at(from);
  if (b < a) return mean(to, from);
  double sum = 0, left = a, left_value = at(from);
  const auto add_until = [&](double right) {
    const double right_value = at(right * nm);
    sum += (right - left) * (left_value + right_value) / 2;
    left = right;
    left_value = right_value;
  };
  for (auto node = std::upper_bound(wavelength_nm.begin(), wavelength_nm.end(), a);
       node != wavelength_nm.end() && *node < b; ++node)
    add_until(*node);
  add_until(b);
  return sum / (b - a);
}

Spectrum constant_spectrum(double value) { return {{550}, {value}}; }

}  // namespace skylapse::sky::atmosphere
