#include "color/cie_observer.h"

#include <algorithm>
#include <cassert>

#include "data/cie1931.h"

namespace skylapse::color {

std::vector<glm::dvec3> xyz_weights(std::span<const Wavelength> nodes) {
  assert(!nodes.empty() && std::is_sorted(nodes.begin(), nodes.end()));
  std::vector<glm::dvec3> weights(nodes.size(), glm::dvec3(0.0));
  size_t upper = 0;  // first node at or beyond the wavelength of the table's row
  for (size_t row = 0; row < data::kCie1931.size(); ++row) {
    const Wavelength wavelength = data::kCie1931WavelengthNm[row] * nm;
    const auto& bar = data::kCie1931[row];
    const glm::dvec3 xyz(bar[0], bar[1], bar[2]);
    while (upper < nodes.size() && nodes[upper] < wavelength) ++upper;
    if (upper == 0) {
      weights.front() += xyz;
    } else if (upper == nodes.size()) {
      weights.back() += xyz;
    } else {
      const double t = (wavelength - nodes[upper - 1]) / (nodes[upper] - nodes[upper - 1]);
      weights[upper - 1] += (1.0 - t) * xyz;
      weights[upper] += t * xyz;
    }
  }
  return weights;
}

Color<Xyz> xyz_of_spectrum(std::span<const Wavelength> nodes, std::span<const double> values) {
  assert(nodes.size() == values.size());
  const std::vector<glm::dvec3> weights = xyz_weights(nodes);
  Color<Xyz> sum;
  for (size_t i = 0; i < values.size(); ++i) sum.value += weights[i] * values[i];
  return sum;
}

}  // namespace skylapse::color
