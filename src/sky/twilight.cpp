#include "sky/twilight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
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

/// Monotone cubic interpolation through points (Fritsch and Butland 1984): the slope at a node is
/// the weighted harmonic mean of its neighbours'. `flat_start` makes it zero at the first node, so
/// that the curve runs smoothly into the constant that it is outside its nodes.
class MonotoneCurve {
 public:
  void add(double x, double y) { nodes_.push_back({x, y, 0}); }

  void fit(bool flat_start = false) {
    const auto secant = [&](size_t i) {
      return (nodes_[i + 1].y - nodes_[i].y) / (nodes_[i + 1].x - nodes_[i].x);
    };
    for (size_t i = 1; i + 1 < nodes_.size(); ++i) {
      const double before = nodes_[i].x - nodes_[i - 1].x;
      const double after = nodes_[i + 1].x - nodes_[i].x;
      const double weight = (before + 2 * after) / (3 * (before + after));
      if (secant(i - 1) * secant(i) > 0)  // at an extremum the slope stays 0
        nodes_[i].slope = 1 / (weight / secant(i - 1) + (1 - weight) / secant(i));
    }
    nodes_.front().slope = flat_start ? 0 : secant(0);
    nodes_.back().slope = secant(nodes_.size() - 2);
  }

  [[nodiscard]] double at(double x) const {
    x = std::clamp(x, nodes_.front().x, nodes_.back().x);
    const auto above = std::upper_bound(nodes_.begin() + 1, nodes_.end() - 1, x,
                                        [](double v, const Node& n) { return v < n.x; });
    const Node& a = *(above - 1);
    const Node& b = *above;
    const double width = b.x - a.x;
    const double t = (x - a.x) / width;
    const double rise = 3 * t * t - 2 * t * t * t;
    return (1 - rise) * a.y + rise * b.y +
           width * (t * (1 - t) * (1 - t) * a.slope - t * t * (1 - t) * b.slope);
  }

 private:
  struct Node {
    double x, y, slope;
  };
  std::vector<Node> nodes_;
};

MonotoneCurve make_illuminance_curve() {
  MonotoneCurve curve;
  const auto add = [&](double h) { curve.add(h, published_log10(h)); };
  for (double h = -18; h < -1; h += 0.5) add(h);
  add(-0.8);
  for (double h = -0.5; h < 10; h += 0.5) add(h);
  for (double h = 10; h <= 90; h += 2.5) add(h);
  curve.fit(true);
  return curve;
}

double log10_illuminance(double elevation_deg) {
  static const MonotoneCurve curve = make_illuminance_curve();
  return curve.at(elevation_deg);
}

/// Depression at which the continued sky has reached the published illuminance.
constexpr Angle kBlendDepression = 6 * deg;

/// log10 of the illuminance by the sky alone, in lux, by the sun's elevation: the spectral
/// Hosek-Wilkie sky at turbidity 2.5 and albedo 0.2 (tested to 1 %).
MonotoneCurve make_sky_curve() {
  constexpr std::array<std::array<double, 2>, 13> kLux{{{0, 2354},
                                                        {1, 3279},
                                                        {2, 4175},
                                                        {5, 6309},
                                                        {10, 8789},
                                                        {15, 10557},
                                                        {20, 11923},
                                                        {30, 13895},
                                                        {40, 15135},
                                                        {50, 15887},
                                                        {60, 16408},
                                                        {75, 17139},
                                                        {90, 17864}}};
  MonotoneCurve curve;
  for (const auto& [elevation_deg, sky_lux] : kLux) curve.add(elevation_deg, std::log10(sky_lux));
  curve.fit();
  return curve;
}

/// log10 of the illuminance by the sky alone, in lux, of the computed atmosphere.
MonotoneCurve make_computed_sky_curve() {
  constexpr std::array<std::array<double, 2>, 30> kLux{
      {{-18, 1.342e-05}, {-16, 0.0001059}, {-14, 0.0008108}, {-13, 0.002521}, {-12, 0.006041},
       {-11, 0.016},     {-10, 0.0417},    {-9, 0.1083},     {-8, 0.3094},    {-7, 0.958},
       {-6, 3.068},      {-5, 9.936},      {-4, 32.28},      {-3, 97.15},     {-2, 246.8},
       {-1, 514.6},      {0, 918.1},       {1, 1461},        {2, 2124},       {3, 2850},
       {5, 4313},        {7, 5652},        {10, 7356},       {15, 9543},      {20, 11180},
       {30, 13450},      {45, 15490},      {60, 16650},      {75, 17260},     {90, 17460}}};
  MonotoneCurve curve;
  for (const auto& [elevation_deg, sky_lux] : kLux) curve.add(elevation_deg, std::log10(sky_lux));
  curve.fit();
  return curve;
}

}  // namespace

Illuminance clear_sky_illuminance(Angle true_sun_elevation) {
  return std::pow(10.0, log10_illuminance(true_sun_elevation.in(deg))) * lux;
}

Luminance mean_clear_sky_luminance(Angle sun_elevation) {
  static const MonotoneCurve curve = make_sky_curve();
  return std::pow(10.0, curve.at(sun_elevation.in(deg))) / std::numbers::pi * cd_per_m2;
}

Luminance mean_computed_sky_luminance(Angle sun_elevation) {
  static const MonotoneCurve curve = make_computed_sky_curve();
  static const double night_lux = std::pow(10.0, log10_illuminance(-18));
  const double sky_lux = std::pow(10.0, curve.at(sun_elevation.in(deg)));
  return (sky_lux + night_lux) / std::numbers::pi * cd_per_m2;
}

double twilight_level(Angle true_elevation, Angle horizon_true_elevation,
                      Illuminance sky_at_horizon) {
  if (true_elevation >= horizon_true_elevation) return 1.0;
  const double at_horizon = log10_illuminance(horizon_true_elevation.in(deg));
  const double fall = log10_illuminance(true_elevation.in(deg)) - at_horizon;
  const double t = std::min(1.0, (horizon_true_elevation - true_elevation) / kBlendDepression);
  const double blend = t * t * (3 - 2 * t);
  return std::pow(10.0, fall + blend * (at_horizon - std::log10(sky_at_horizon.in(lux))));
}

}  // namespace skylapse::sky
