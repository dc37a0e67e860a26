#include "sky/monte_carlo/sun_guide.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sky/monte_carlo/optics.h"

namespace skylapse::sky::monte_carlo {
namespace {

constexpr int kNodes = 128;
/// Light from where the sun stands 4 deg (450 km) higher is an order fainter, and so on: the fall
/// of the twilight zenith, an order every 1.5 to 2.5 deg, is steeper still.
constexpr double kStep = 4 * std::numbers::pi / 180;
constexpr double kPerStep = 0.1;
constexpr int kSteps = 6;
/// Under the sun, haze passes diffuse light on by 1 / (1 + 0.75 (1 - g) depth) (two streams), here
/// at g 0.8; a twentieth of it tells best where twilight comes from.
constexpr double kDimming = 0.15, kDiffuse = 0.05;

}  // namespace

SunGuide::SunGuide(const Optics& optics)
    : radius_(optics.shells.radius()), top_(optics.shells.top()) {
  PerBand transmittance;
  for (int i = 0; i < kNodes; ++i) {
    const double share = double(i) / (kNodes - 1);
    Columns columns = optics.shells.to_top(top_ * share * share, 0);
    columns += columns;
    optics.transmittances(columns, transmittance);
    double mean = 0;
    for (int b = 0; b < optics.bands; ++b) mean += transmittance[size_t(b)] / optics.bands;
    grazing_.push_back(mean);
  }
}

double SunGuide::sunlight(double height, double zenith) const {
  const bool up = zenith < std::numbers::pi / 2;
  // The lowest point of the sun's ray.
  const double lowest = up ? height : (radius_ + height) * std::sin(zenith) - radius_;
  if (lowest <= 0 && !up) return 0;
  const double x = std::sqrt(std::clamp(lowest / top_, 0.0, 1.0)) * (kNodes - 1);
  const int node = std::min(int(x), kNodes - 2);
  const double whole =
      grazing_[size_t(node)] + (grazing_[size_t(node) + 1] - grazing_[size_t(node)]) * (x - node);
  if (!up) return whole;
  const double depth = -std::log(std::max(whole, 1e-300)) / 2;
  return std::exp(-depth) + kDiffuse / (1 + kDimming * depth);
}

double SunGuide::importance(double height, double mu_sun) const {
  double zenith = std::acos(std::clamp(mu_sun, -1.0, 1.0));
  double sum = 1e-12, weight = 1;
  for (int i = 0; i < kSteps; ++i, zenith -= kStep, weight *= kPerStep) {
    sum += weight * sunlight(height, std::max(zenith, 0.0));
    if (zenith < std::numbers::pi / 2) break;  // all nearer places are as bright
  }
  return sum;
}

}  // namespace skylapse::sky::monte_carlo
