#pragma once
// Where light is to be expected when the sun is low or down: a rough guide for sampling. It shapes
// variances only, never means.
#include <vector>

#include "sky/monte_carlo/kernels.h"
#include "sky/monte_carlo/shells.h"

namespace skylapse::sky::monte_carlo {

class Optics;

class SunGuide {
 public:
  SunGuide() = default;
  explicit SunGuide(const Optics& optics);

  /// Zenith cosines of the sun below which the guide is worth its time.
  static constexpr double kLowSun = 0.15;

  /// Expected light at a place, relative: sunlight itself, and what comes after one and more
  /// scattering events from places nearer to the sun, where it stands higher. In (0, 2).
  [[nodiscard]] double importance(double height, double mu_sun) const;

 private:
  [[nodiscard]] double sunlight(double height, double zenith) const;

  double radius_ = 0, top_ = 0;
  /// Mean transmittance over the bands of the whole ray that touches a height, over
  /// sqrt(height / top).
  std::vector<double> grazing_;
};

}  // namespace skylapse::sky::monte_carlo
