#include "study/sky_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "color/rgb_space.h"

namespace skylapse::study {
namespace {

constexpr Angle kZenithRadius = 30 * deg, kHorizonRing = 10 * deg, kAureole = 15 * deg,
                kAntiSolarAzimuth = 135 * deg;

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Angle between two azimuths, 0..180 deg.
Angle azimuth_between(const Direction<Enu>& a, const Direction<Enu>& b) {
  const double cross = a.x() * b.y() - a.y() * b.x(), dot = a.x() * b.x() + a.y() * b.y();
  return abs(atan2_angle(cross, dot));
}

/// Sums over the directions of one region.
class RegionSum {
 public:
  void add(double weight, double error, double noise) {
    weight_ += weight;
    square_ += weight * error * error;
    noise_square_ += weight * noise * noise;
    // Variance of weight * error^2 that noise s in the truth causes about a true error b:
    // 4 b^2 s^2 / 3 + 2 s^4 / 3 when the noise is spread over three components alike.
    const double s2 = noise * noise, b2 = std::max(0.0, error * error - s2);
    variance_ += weight * weight * (4 * b2 * s2 + 2 * s2 * s2) / 3;
    errors_.emplace_back(error, weight);
  }
  [[nodiscard]] ErrorMeasure measure() const {
    ErrorMeasure m;
    m.directions = int(errors_.size());
    m.solid_angle = weight_;
    if (weight_ == 0) return m;
    const double raw = square_ / weight_, noise = noise_square_ / weight_;
    m.raw_rms = std::sqrt(raw);
    m.noise = std::sqrt(noise);
    m.rms = std::isfinite(raw) ? std::sqrt(std::max(0.0, raw - noise)) : m.raw_rms;
    // d(rms) = d(rms^2) / (2 rms), or the root of the spread itself where that is larger.
    const double spread = std::isfinite(variance_) ? std::sqrt(variance_) / weight_ : 0;
    m.rms_uncertainty = std::min(std::sqrt(spread), m.rms > 0 ? spread / (2 * m.rms) : HUGE_VAL);
    m.p95 = weighted_quantile(errors_, 0.95);
    for (const auto& [error, weight] : errors_) m.max = std::max(m.max, error);
    return m;
  }

 private:
  double weight_ = 0, square_ = 0, noise_square_ = 0, variance_ = 0;
  std::vector<std::pair<double, double>> errors_;
};

}  // namespace

double relative_error(const glm::dvec3& xyz, const glm::dvec3& truth) {
  if (!is_finite(xyz)) return std::numeric_limits<double>::infinity();
  const double difference = glm::length(xyz - truth), scale = glm::length(truth);
  if (scale > 0) return difference / scale;
  return difference > 0 ? std::numeric_limits<double>::infinity() : 0;
}

double chromaticity_difference(const glm::dvec3& xyz, const glm::dvec3& truth) {
  if (!(glm::length(xyz) > 0 && glm::length(truth) > 0)) return 0;
  const auto a = color::uniform_chromaticity({xyz}), b = color::uniform_chromaticity({truth});
  return std::hypot(a.u - b.u, a.v - b.v);
}

bool lies_in(SkyRegion region, const Direction<Enu>& direction, const SkyGeometry& geometry) {
  const Angle above = elevation(direction) - geometry.horizon;
  if (above < 0 * deg) return false;
  switch (region) {
    case SkyRegion::sky:
      return true;
    case SkyRegion::zenith:
      return elevation(direction) >= 90 * deg - kZenithRadius;
    case SkyRegion::horizon:
      return above <= kHorizonRing;
    case SkyRegion::aureole:
      return separation(direction, geometry.sun) <= kAureole;
    case SkyRegion::anti_solar:
      return azimuth_between(direction, geometry.sun) >= kAntiSolarAzimuth;
  }
  return false;
}

double weighted_quantile(std::vector<std::pair<double, double>> value_and_weight, double share) {
  std::sort(value_and_weight.begin(), value_and_weight.end());
  double total = 0;
  for (const auto& [value, weight] : value_and_weight) total += weight;
  double below = 0;
  for (const auto& [value, weight] : value_and_weight) {
    below += weight;
    if (below >= share * total) return value;
  }
  return value_and_weight.empty() ? 0 : value_and_weight.back().first;
}

SkyErrors sky_errors(std::span<const SkyDirection> directions, std::span<const glm::dvec3> xyz,
                     std::span<const TrueRadiance> truth, const SkyGeometry& geometry) {
  assert(directions.size() == xyz.size() && xyz.size() == truth.size());
  std::array<RegionSum, kSkyRegions> sums;
  SkyErrors out;
  double weight = 0, square = 0;
  for (size_t i = 0; i < directions.size(); ++i) {
    const auto& [toward, solid_angle] = directions[i];
    if (!lies_in(SkyRegion::sky, toward, geometry)) continue;
    const double w = solid_angle.in(sr), error = relative_error(xyz[i], truth[i].xyz);
    const double scale = glm::length(truth[i].xyz);
    const double noise = scale > 0 ? glm::length(truth[i].standard_error) / scale : 0;
    for (int region = 0; region < kSkyRegions; ++region)
      if (lies_in(SkyRegion(region), toward, geometry)) sums[region].add(w, error, noise);
    const double hue = chromaticity_difference(xyz[i], truth[i].xyz);
    out.chromaticity.max = std::max(out.chromaticity.max, hue);
    weight += w, square += w * hue * hue;
  }
  for (int region = 0; region < kSkyRegions; ++region)
    out.by_region[region] = sums[region].measure();
  if (weight > 0) out.chromaticity.rms = std::sqrt(square / weight);
  return out;
}

}  // namespace skylapse::study
