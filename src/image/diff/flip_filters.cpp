#include "image/diff/flip_filters.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numbers>

namespace skylapse::image::flip_internal {
namespace {

constexpr double kPi = std::numbers::pi;
/// Taps below this share of a kernel change no error by 1e-6, even behind the exponents.
constexpr double kNegligible = 1e-10;

/// a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees: contrast sensitivity (2020, table 1, after
/// Johnson & Fairchild 2003).
struct Sensitivity {
  double a, b;
};
constexpr Sensitivity kLuminance{1, 0.0047}, kRedGreen{1, 0.0053};
constexpr Sensitivity kBlueYellow[] = {{34.1, 0.04}, {13.5, 0.025}};
constexpr double kWidestB = 0.04;

/// Width of the feature detectors in degrees (2020, section 4.2).
constexpr double kFeatureWidthDeg = 0.082;

using Shape = std::function<double(int)>;

/// Sum over both sides.
double sum_of(const Shape& shape, int radius) {
  double sum = shape(0);
  for (int x = 1; x <= radius; ++x) sum += 2 * shape(x);
  return sum;
}

Taps taps_of(const Shape& shape, int radius, double factor) {
  Taps taps;
  for (int x = 0; x <= radius; ++x) taps.weight.push_back(float(factor * shape(x)));
  while (taps.weight.size() > 1 && std::abs(taps.weight.back()) < kNegligible)
    taps.weight.pop_back();
  return taps;
}

Shape gauss(const Sensitivity& s, double pixels_per_degree) {
  return [=](int x) {
    const double degrees = x / pixels_per_degree;
    return std::exp(-kPi * kPi * degrees * degrees / s.b);
  };
}

Taps unit_taps(const Shape& shape, int radius) {
  return taps_of(shape, radius, 1 / sum_of(shape, radius));
}

void add_blue_yellow(Filters& filters, int radius, double pixels_per_degree) {
  double share[2], total = 0;
  for (int i = 0; i < 2; ++i) {
    const double sum = sum_of(gauss(kBlueYellow[i], pixels_per_degree), radius);
    share[i] = kBlueYellow[i].a * std::sqrt(kPi / kBlueYellow[i].b) * sum * sum;
    total += share[i];
  }
  for (int i = 0; i < 2; ++i) {
    const Shape shape = gauss(kBlueYellow[i], pixels_per_degree);
    filters.blue_yellow[i] = unit_taps(shape, radius);
    filters.blue_yellow_weighted[i] =
        taps_of(shape, radius, share[i] / total / sum_of(shape, radius));
  }
}

void add_features(Filters& filters, double pixels_per_degree) {
  const double sigma = 0.5 * kFeatureWidthDeg * pixels_per_degree;
  const int radius = int(std::ceil(3 * sigma));
  const Shape smooth = [=](int x) { return std::exp(-x * x / (2 * sigma * sigma)); };
  const Shape edge = [=](int x) { return -x * smooth(x); };
  const Shape point = [=](int x) { return (x * x / (sigma * sigma) - 1) * smooth(x); };
  filters.smooth = unit_taps(smooth, radius);
  const double edge_sum = (sum_of(edge, radius) - edge(0)) / 2;  // one side's
  filters.edge = taps_of(edge, radius, 1 / std::abs(edge_sum));
  const auto positive = [=](int x) { return std::max(point(x), 0.0); };
  const auto negative = [=](int x) { return std::max(-point(x), 0.0); };
  const double up = sum_of(positive, radius), down = sum_of(negative, radius);
  // At few pixels per degree no tap may be positive.
  filters.point = taps_of(
      [&](int x) { return (up > 0 ? positive(x) / up : 0) - negative(x) / down; }, radius, 1);
}

}  // namespace

Filters filters_for(double pixels_per_degree) {
  assert(pixels_per_degree > 0 && pixels_per_degree <= 1000);
  Filters filters;
  const int radius = int(std::ceil(3 * std::sqrt(kWidestB / (2 * kPi * kPi)) * pixels_per_degree));
  filters.luminance = unit_taps(gauss(kLuminance, pixels_per_degree), radius);
  filters.red_green = unit_taps(gauss(kRedGreen, pixels_per_degree), radius);
  add_blue_yellow(filters, radius, pixels_per_degree);
  add_features(filters, pixels_per_degree);
  for (const Taps* taps : {&filters.luminance, &filters.red_green, &filters.blue_yellow[0],
                           &filters.blue_yellow[1], &filters.smooth, &filters.edge, &filters.point})
    filters.radius = std::max(filters.radius, taps->radius());
  return filters;
}

}  // namespace skylapse::image::flip_internal
