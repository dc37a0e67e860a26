#pragma once
// How the number density of an air component falls with height.
#include <vector>

#include "core/quantity.h"
#include "core/result.h"

namespace skylapse::sky::atmosphere {

/// One term of a profile: on bottom_km <= h < top_km the value
///   amplitude * exp(-h / scale_height) + slope * h + constant, not less than 0;
/// elsewhere 0. Heights are above the planet's surface.
struct DensityTerm {
  double bottom_km = 0;
  double top_km = 0;
  double amplitude = 0;
  double inverse_scale_height_per_km = 0;  // may be negative: density that grows with height
  double slope_per_km = 0;
  double constant = 0;
};

/// Relative density (1 where the component's coefficients are quoted): the sum of its terms. Terms
/// side by side make a piecewise profile, terms on top of each other add layers.
struct DensityProfile {
  std::vector<DensityTerm> terms;  // at most kMaxDensityTerms

  /// Density at a height; 0 outside all terms. Never negative, never NaN for finite heights.
  [[nodiscard]] double at(double height_km) const;
  /// Integral of the density from height 0 to `top_km` [km]; closed form.
  [[nodiscard]] double vertical_column_km(double top_km) const;
  /// The heights in (0, top) where a term begins, ends or reaches 0: integrals are cut there.
  [[nodiscard]] std::vector<double> breaks_km(double top_km) const;
};

inline constexpr int kMaxDensityTerms = 8;

/// exp(-h / scale_height) up to `top`.
DensityProfile exponential_profile(Length scale_height, Length top);
/// 0 at `bottom`, 1 at `peak`, 0 at `top`, linear between.
DensityProfile tent_profile(Length bottom, Length peak, Length top);

}  // namespace skylapse::sky::atmosphere
