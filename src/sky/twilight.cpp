#include "sky/twilight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace skylapse::sky {
namespace {

/// log10 E[lx] = sum of l_k x^k, x = elevation / 90 deg. USNO Circular 171, sun.
struct Piece {
  double from_deg, to_deg;
  std::array<double, 4> l;
};
constexpr std::array kPieces{
    Piece{-18, -12, {13.84, 262.72, 1447.42, 2797.93}},
    Piece{-12, -5, {2.70, 12.17, -431.69, -1899.83}},
    Piece{-5, -0.8, {2.88, 21.81, -258.11, -858.36}},
    Piece{-0.8, 5, {2.88, 22.26, -207.64, 1034.30}},
    Piece{5, 20, {3.05, 13.28, -45.98, 64.33}},
    Piece{20, 90, {3.74, 3.97, -4.07, 1.47}},
};

/// Published value; at a joint the mean of the two pieces that meet there.
double published_log10(double elevation_deg) {
  double sum = 0;
  int count = 0;
  for (const Piece& piece : kPieces) {
    if (elevation_deg < piece.from_deg || elevation_deg > piece.to_deg) continue;
    const double x = elevation_deg / 90;
    sum += ((piece.l[3] * x + piece.l[2]) * x + piece.l[1]) * x + piece.l[0];
    ++count;
  }
  return sum / count;
}

struct Node {
  double elevation_deg, log10_lux, slope;
};

/// Monotone cubic interpolation (Fritsch and Butland 1984): the slope at a node is the weighted
/// harmonic mean of its neighbours'. Zero at -18 deg, so the curve runs smoothly into a constant.
std::vector<Node> make_curve() {
  std::vector<Node> nodes;
  auto add = [&](double h) { nodes.push_back({h, published_log10(h), 0}); };
  for (double h = -18; h < -1; h += 0.5) add(h);
  add(-0.8);
  for (double h = -0.5; h < 10; h += 0.5) add(h);
  for (double h = 10; h <= 90; h += 2.5) add(h);
  auto secant = [&](size_t i) {
    return (nodes[i + 1].log10_lux - nodes[i].log10_lux) /
           (nodes[i + 1].elevation_deg - nodes[i].elevation_deg);
  };
  for (size_t i = 1; i + 1 < nodes.size(); ++i) {
    const double before = nodes[i].elevation_deg - nodes[i - 1].elevation_deg;
    const double after = nodes[i + 1].elevation_deg - nodes[i].elevation_deg;
    const double weight = (before + 2 * after) / (3 * (before + after));
    nodes[i].slope = 1 / (weight / secant(i - 1) + (1 - weight) / secant(i));
  }
  nodes.back().slope = secant(nodes.size() - 2);
  return nodes;
}

double curve_log10(double elevation_deg) {
  static const std::vector<Node> nodes = make_curve();
  const double h =
      std::clamp(elevation_deg, nodes.front().elevation_deg, nodes.back().elevation_deg);
  const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, h,
                                      [](double v, const Node& n) { return v < n.elevation_deg; });
  const Node& a = *(above - 1);
  const Node& b = *above;
  const double width = b.elevation_deg - a.elevation_deg;
  const double t = (h - a.elevation_deg) / width;
  const double rise = 3 * t * t - 2 * t * t * t;
  return (1 - rise) * a.log10_lux + rise * b.log10_lux +
         width * (t * (1 - t) * (1 - t) * a.slope - t * t * (1 - t) * b.slope);
}

}  // namespace

Illuminance clear_sky_illuminance(Angle true_sun_elevation) {
  return std::pow(10.0, curve_log10(true_sun_elevation.in(deg))) * lux;
}

double twilight_level(Angle true_elevation, Angle horizon_true_elevation) {
  if (true_elevation >= horizon_true_elevation) return 1.0;
  return std::pow(
      10.0, curve_log10(true_elevation.in(deg)) - curve_log10(horizon_true_elevation.in(deg)));
}

}  // namespace skylapse::sky
