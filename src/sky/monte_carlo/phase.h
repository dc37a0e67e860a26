#pragma once
// Phase functions with their samplers. nu is the cosine of the scattering angle, +1 is forward;
// values in 1/sr integrate to 1 over the sphere.
#include <cmath>
#include <numbers>

#include "sky/monte_carlo/random.h"

namespace skylapse::sky::monte_carlo {

/// Rayleigh scattering of unpolarised light by molecules of depolarisation rho (Chandrasekhar 1950,
/// section 18; in the form of Bucholtz 1995, Eq. 12): (1 + 3 gamma + (1 - gamma) nu^2), with
/// gamma = rho / (2 - rho). rho = 0 is 3 / (16 pi) (1 + nu^2).
class RayleighPhase {
 public:
  explicit RayleighPhase(double depolarization) {
    const double gamma = depolarization / (2 - depolarization);
    const double scale = 3 / (16 * std::numbers::pi * (1 + 2 * gamma));
    even_ = scale * (1 + 3 * gamma);
    square_ = scale * (1 - gamma);
  }
  [[nodiscard]] double at(double nu) const { return even_ + square_ * nu * nu; }
  /// A mixture: isotropic, or in proportion to nu^2.
  double sample(PathRandom& random) const {
    const double u = random.uniform();
    const double v = 2 * random.uniform() - 1;
    return u * (even_ + square_ / 3) < even_ ? v : std::cbrt(v);
  }

 private:
  double even_, square_;
};

/// Form of the aerosol's phase function.
enum class AerosolShape {
  cornette_shanks,    // what a medium means by aerosol_g
  henyey_greenstein,  // for comparison with published clouds
};

/// Cornette & Shanks 1992, Eq. (8), or Henyey & Greenstein 1941, for a shape parameter g in (-1,
/// 1), which of the second is the mean cosine.
class AerosolPhase {
 public:
  explicit AerosolPhase(double g, AerosolShape shape = AerosolShape::cornette_shanks)
      : g_(g),
        square_(shape == AerosolShape::cornette_shanks ? 1 : 0),
        scale_((1 - g * g) / (4 * std::numbers::pi)) {
    if (shape == AerosolShape::cornette_shanks) scale_ *= 1.5 / (2 + g * g);
  }
  [[nodiscard]] double at(double nu) const {
    // 1 + g^2 - 2 g nu without cancellation where both g and nu are near 1.
    const double d = (1 - g_) * (1 - g_) + 2 * g_ * (1 - nu);
    return scale_ * (1 + square_ * nu * nu) / (d * std::sqrt(d));
  }
  /// Henyey & Greenstein's cosine, accepted for the other with (1 + nu^2) / 2: at least every
  /// second.
  double sample(PathRandom& random) const {
    for (;;) {
      const double v = 2 * random.uniform() - 1;
      double nu = v;
      if (std::abs(g_) > 1e-3) {
        const double f = (1 - g_ * g_) / (1 + g_ * v);
        nu = (1 + g_ * g_ - f * f) / (2 * g_);
      } else {
        nu = v + 1.5 * g_ * (1 - v * v);  // the series in g; what it leaves out is of order g^2
      }
      if (nu < -1) nu = -1;
      if (nu > 1) nu = 1;
      if (square_ == 0 || 2 * random.uniform() < 1 + nu * nu) return nu;
    }
  }
  [[nodiscard]] double g() const { return g_; }

 private:
  double g_, square_, scale_;
};

}  // namespace skylapse::sky::monte_carlo
