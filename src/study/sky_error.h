#pragma once
// How far a sky is from the truth: one relative error a direction, and its statistics by solid
// angle over the whole sky and over the parts of it where models err in their own ways.
//
// The error of a direction is |XYZ - XYZ_true| / |XYZ_true|, both norms Euclidean: brightness and
// colour in one number that is never negative. The rms of `SkyErrors::sky` is what `sky.accuracy`
// of a config promises.
#include <array>
#include <glm/glm.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "core/frames.h"

namespace skylapse::study {

/// A direction of the sky that stands for a solid angle.
struct SkyDirection {
  Direction<Enu> toward;
  SolidAngle solid_angle;
};

/// What the sky truly is in a direction, in XYZ [W m^-2 sr^-1 in CIE's weighting], with the
/// standard error of each component (0 where the truth has no noise).
struct TrueRadiance {
  glm::dvec3 xyz{0};
  glm::dvec3 standard_error{0};
};

/// Parts of the sky above the camera's horizon, all without the sun's disc. They overlap.
enum class SkyRegion {
  sky,         // all of it
  zenith,      // within 30 deg of the zenith
  horizon,     // the ring from the horizon to 10 deg above it
  aureole,     // within 15 deg of the sun
  anti_solar,  // azimuth at least 135 deg from the sun's
};
inline constexpr int kSkyRegions = 5;
inline constexpr std::array<std::string_view, kSkyRegions> kSkyRegionNames{
    "sky", "zenith", "horizon", "aureole", "anti_solar"};

/// Statistics of the relative error over a part of the sky, by solid angle; shares, not percent.
struct ErrorMeasure {
  /// Root of the mean square of the error, the truth's noise taken off: sqrt(raw^2 - noise^2), 0
  /// where the noise explains all of it. Unbiased in the square where picture and truth are
  /// independent.
  double rms = 0;
  double raw_rms = 0;  // as measured, noise of the truth included
  double noise = 0;    // rms of the truth's relative standard error
  /// Standard error of `rms` that the truth's noise causes (it is `noise` itself, shrunk by the
  /// number of directions); first order.
  double rms_uncertainty = 0;
  double p95 = 0;          // 95 % of the solid angle have at most this error, noise included
  double max = 0;          // of all directions, noise included
  double solid_angle = 0;  // sr; 0: no direction lies in this part, all others mean nothing
  int directions = 0;
};

/// Difference of chromaticity, CIE 1976: sqrt(du'^2 + dv'^2), noise of the truth included.
struct ChromaticityMeasure {
  double rms = 0, max = 0;
};

struct SkyErrors {
  std::array<ErrorMeasure, kSkyRegions> by_region;
  ChromaticityMeasure chromaticity;
  [[nodiscard]] const ErrorMeasure& operator[](SkyRegion region) const {
    return by_region[size_t(region)];
  }
  [[nodiscard]] const ErrorMeasure& sky() const { return (*this)[SkyRegion::sky]; }
};

/// Where the sun and the horizon stand in a picture.
struct SkyGeometry {
  Direction<Enu> sun;
  Angle horizon{};  // elevation, at most 0
};

/// |xyz - truth| / |truth|. Infinite where `xyz` is not finite, or where the truth is black and
/// the picture is not.
double relative_error(const glm::dvec3& xyz, const glm::dvec3& truth);

/// Distance of two colours in CIE 1976 u'v'; 0 where either is black.
double chromaticity_difference(const glm::dvec3& xyz, const glm::dvec3& truth);

/// Whether a direction counts in a part of the sky. Directions below the horizon are in none.
bool lies_in(SkyRegion region, const Direction<Enu>& direction, const SkyGeometry& geometry);

/// Compares a picture with the truth, direction by direction (the three lists are of one length,
/// asserted). The order of the directions does not matter but for rounding.
SkyErrors sky_errors(std::span<const SkyDirection> directions, std::span<const glm::dvec3> xyz,
                     std::span<const TrueRadiance> truth, const SkyGeometry& geometry);

/// The smallest value that `share` (0..1) of the weight does not exceed; 0 of nothing.
double weighted_quantile(std::vector<std::pair<double, double>> value_and_weight, double share);

}  // namespace skylapse::study
