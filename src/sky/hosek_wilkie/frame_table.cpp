#include "sky/hosek_wilkie/frame_table.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>

#include "core/parallel.h"

namespace skylapse::sky::hosek_wilkie {
namespace {

using kernel::kIntervalFloats;
using kernel::kIntervals;
using kernel::kRowFloats;
using kernel::kRowSteps;

constexpr std::align_val_t kCacheLine{64};
/// Each cubic passes through four points of its interval, t = 0, 1/4, 3/4, 1 (the extrema of the
/// Chebyshev polynomial of degree 3); neighbours share the ends, so the curve is continuous.
constexpr int kPointsPerInterval = 3;
constexpr int kPoints = kIntervals * kPointsPerInterval + 1;

struct SunAngle {
  Angle gamma;
  double cosine;
};

/// Angle to the sun at coordinate q; half-angle forms keep its digits at both ends.
SunAngle sun_angle(double q) {
  constexpr double kRoot2 = std::numbers::sqrt2;
  if (q <= 1) return {2 * std::asin(q / kRoot2) * rad, 1 - q * q};
  const double p = 2 - q;
  return {(std::numbers::pi - 2 * std::asin(p / kRoot2)) * rad, p * p - 1};
}

const std::array<SunAngle, kPoints>& sun_angles() {
  static const auto angles = [] {
    constexpr std::array kPlaces{0.0, 0.25, 0.75};
    std::array<SunAngle, kPoints> all;
    for (int n = 0; n < kPoints; ++n)
      all[n] = sun_angle(2.0 / kIntervals * (n / kPointsPerInterval + kPlaces[n % 3]));
    return all;
  }();
  return angles;
}

/// Coefficients of 1, t, t^2, t^3 through y at t = 0, 1/4, 3/4, 1.
std::array<double, 4> cubic_through(const double* y) {
  const double d1 = y[1] - y[0], d2 = y[2] - y[0], d3 = y[3] - y[0];
  const double k1 = 8 * d1 - 8.0 / 3 * d2 + d3;
  const double k2 = (64 * d1 - d3 - 15 * k1) / 3;
  return {y[0], k1, k2, d3 - k1 - k2};
}

}  // namespace

AlignedFloats::AlignedFloats(size_t count)
    : floats_(static_cast<float*>(::operator new(count * sizeof(float), kCacheLine))) {}

void AlignedFloats::Free::operator()(float* p) const { ::operator delete(p, kCacheLine); }

FrameTable::FrameTable(const Sky& sky, const glm::dmat3& scale_to_rgb)
    : sky_(sky),
      coefficients_(size_t(sky.patterns().count) * kRowFloats),
      constants_(size_t(sky.patterns().count) * kIntervals * 4) {
  for (int band = 0; band < sky.patterns().count; ++band) {
    const Pattern& pattern = sky.patterns().items[band];
    colours_[band] = scale_to_rgb * sky.xyz_weights()[band];
    std::array<double, kPoints> values;
    for (int n = 0; n < kPoints; ++n)
      values[n] = lobes(pattern, sun_angles()[n].gamma, sun_angles()[n].cosine);
    for (int interval = 0; interval < kIntervals; ++interval) {
      const auto k = cubic_through(&values[interval * kPointsPerInterval]);
      const size_t at = size_t(interval) * sky.patterns().count + band;
      for (int place = 0; place < 4; ++place)
        for (int c = 0; c < 4; ++c)
          coefficients_.data()[at * kIntervalFloats + 4 * place + c] =
              c < 3 ? static_cast<float>(k[kernel::kPowers[place]] * colours_[band][c]) : 0.0f;
      for (int c = 0; c < 3; ++c) constants_[at * 4 + c] = k[0] * colours_[band][c];
    }
  }
}

void FrameTable::make_row(double w, float* row) const {
  std::array<double, kBandCount> weights{};
  std::array<double, 4> offset{};
  for (int band = 0; band < sky_.patterns().count; ++band) {
    const Pattern& pattern = sky_.patterns().items[band];
    weights[band] = horizon_gradient(pattern, w * w);
    for (int c = 0; c < 3; ++c) offset[c] += weights[band] * pattern.i * w * colours_[band][c];
  }
  kernel::combine_bands({coefficients_.data(), constants_.data(), sky_.patterns().count},
                        weights.data(), offset.data(), row);
}

AlignedFloats FrameTable::make_rows() const {
  AlignedFloats rows(size_t(kRowSteps + 1) * kRowFloats);
  parallel_for_ranges(kRowSteps + 1, 32, [&](size_t begin, size_t end) {
    for (size_t n = begin; n < end; ++n)
      make_row(double(n) / kRowSteps, rows.data() + n * kRowFloats);
  });
  return rows;
}

glm::vec3 look_up_one(const AlignedFloats& rows, double q, double w) {
  const double s = w * kRowSteps, t = q * kIntervals / 2;
  const int row = std::min(static_cast<int>(s), kRowSteps - 1);
  const int interval = std::min(static_cast<int>(t), kIntervals - 1);
  const float* a = rows.data() + size_t(row) * kRowFloats + interval * kIntervalFloats;
  const float f = static_cast<float>(s - row), u = static_cast<float>(t - interval);
  glm::vec3 rgb;
  for (int c = 0; c < 3; ++c) {
    std::array<float, 4> k;
    for (int place = 0; place < 4; ++place) {
      const float low = a[4 * place + c], high = a[kRowFloats + 4 * place + c];
      k[kernel::kPowers[place]] = low + f * (high - low);
    }
    rgb[c] = std::max(0.0f, k[0] + u * (k[1] + u * (k[2] + u * k[3])));
  }
  return rgb;
}

}  // namespace skylapse::sky::hosek_wilkie
