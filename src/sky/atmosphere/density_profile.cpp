#include "sky/atmosphere/density_profile.h"

#include <algorithm>
#include <cmath>

namespace skylapse::sky::atmosphere {
namespace {

/// The term's formula, before it is cut at 0.
double raw(const DensityTerm& t, double height_km) {
  // Without the test 0 * inf would be NaN far from the ground.
  const double exponential =
      t.amplitude == 0 ? 0 : t.amplitude * std::exp(-t.inverse_scale_height_per_km * height_km);
  return exponential + t.slope_per_km * height_km + t.constant;
}

/// The zero of the formula between two heights at which it has different signs.
double zero_between(const DensityTerm& t, double low, double high) {
  if (t.amplitude == 0) return -t.constant / t.slope_per_km;
  const bool rises = raw(t, low) < 0;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = low + (high - low) / 2;
    if (middle == low || middle == high) break;
    ((raw(t, middle) < 0) == rises ? low : high) = middle;
  }
  return low;
}

/// Heights in [from, to] at which the formula changes sign: at most two, since an exponential plus
/// a straight line turns at most once.
std::vector<double> zeros(const DensityTerm& t, double from, double to) {
  std::vector<double> pieces{from};
  const double k = t.inverse_scale_height_per_km;
  const double ratio = t.amplitude * k == 0 ? 0 : t.slope_per_km / (t.amplitude * k);
  if (ratio > 0) {
    const double turn = -std::log(ratio) / k;
    if (turn > from && turn < to) pieces.push_back(turn);
  }
  pieces.push_back(to);
  std::vector<double> found;
  for (size_t i = 0; i + 1 < pieces.size(); ++i)
    if ((raw(t, pieces[i]) < 0) != (raw(t, pieces[i + 1]) < 0))
      found.push_back(zero_between(t, pieces[i], pieces[i + 1]));
  return found;
}

/// Integral of the formula over [from, to].
double raw_column(const DensityTerm& t, double from, double to) {
  const double length = to - from;
  double exponential = 0;
  if (t.amplitude != 0) {
    const double k = t.inverse_scale_height_per_km;
    const double mean_path = k == 0 ? length : -std::expm1(-k * length) / k;
    exponential = t.amplitude * std::exp(-k * from) * mean_path;
  }
  return exponential + (t.slope_per_km * (from + to) / 2 + t.constant) * length;
}

double term_column(const DensityTerm& t, double top_km) {
  const double from = std::max(t.bottom_km, 0.0), to = std::min(t.top_km, top_km);
  if (!(from < to)) return 0;
  std::vector<double> cuts = zeros(t, from, to);
  cuts.insert(cuts.begin(), from);
  cuts.push_back(to);
  double sum = 0;
  // A piece has one sign, which its integral shows: densities within it may underflow.
  for (size_t i = 0; i + 1 < cuts.size(); ++i)
    sum += std::max(raw_column(t, cuts[i], cuts[i + 1]), 0.0);
  return sum;
}

}  // namespace

double DensityProfile::at(double height_km) const {
  double sum = 0;
  for (const DensityTerm& term : terms)
    if (height_km >= term.bottom_km && height_km < term.top_km)
      sum += std::max(0.0, raw(term, height_km));
  return sum;
}

double DensityProfile::vertical_column_km(double top_km) const {
  double sum = 0;
  for (const DensityTerm& term : terms) sum += term_column(term, top_km);
  return sum;
}

std::vector<double> DensityProfile::breaks_km(double top_km) const {
  std::vector<double> breaks;
  for (const DensityTerm& term : terms) {
    breaks.push_back(term.bottom_km);
    breaks.push_back(term.top_km);
    const double from = std::max(term.bottom_km, 0.0), to = std::min(term.top_km, top_km);
    if (from < to)
      for (const double zero : zeros(term, from, to)) breaks.push_back(zero);
  }
  std::erase_if(breaks, [&](double h) { return !(h > 0 && h < top_km); });
  std::sort(breaks.begin(), breaks.end());
  // A tent's zero falls on the end of its term but for rounding: one cut is enough.
  constexpr double kSameKm = 1e-9;
  const auto same = [](double a, double b) { return std::abs(b - a) < kSameKm; };
  breaks.erase(std::unique(breaks.begin(), breaks.end(), same), breaks.end());
  return breaks;
}

DensityProfile exponential_profile(Length scale_height, Length top) {
  return {{{.top_km = top.in(km),
            .amplitude = 1,
            .inverse_scale_height_per_km = 1 / scale_height.in(km)}}};
}

DensityProfile tent_profile(Length bottom, Length peak, Length top) {
  const double b = bottom.in(km), p = peak.in(km), t = top.in(km);
  DensityProfile profile;
  if (b < p)
    profile.terms.push_back(
        {.bottom_km = b, .top_km = p, .slope_per_km = 1 / (p - b), .constant = -b / (p - b)});
  if (p < t)
    profile.terms.push_back(
        {.bottom_km = p, .top_km = t, .slope_per_km = -1 / (t - p), .constant = t / (t - p)});
  return profile;
}

}  // namespace skylapse::sky::atmosphere
