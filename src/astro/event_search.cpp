#include "astro/event_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace skylapse::astro {
namespace {

constexpr double kTimeTolerance = 1e-4;     // s, of a crossing
constexpr double kExtremeTolerance = 0.05;  // s; the value is then off by 1e-6 arcsec

/// Golden-section search for the largest sign * f in [low, high].
TimeSample extreme(const TimeFunction& f, double sign, double low, double high) {
  constexpr double kGolden = 0.6180339887498949;
  TimeSample left{high - kGolden * (high - low), 0};
  TimeSample right{low + kGolden * (high - low), 0};
  left.value = f(left.time_s);
  right.value = f(right.time_s);
  while (high - low > kExtremeTolerance) {
    if (sign * left.value > sign * right.value) {
      high = right.time_s;
      right = std::exchange(left, {high - kGolden * (high - low), 0});
      left.value = f(left.time_s);
    } else {
      low = left.time_s;
      left = std::exchange(right, {low + kGolden * (high - low), 0});
      right.value = f(right.time_s);
    }
  }
  return sign * left.value > sign * right.value ? left : right;
}

}  // namespace

SampledCurve::SampledCurve(TimeFunction f, double begin_s, double end_s, double step_s)
    : f_(std::move(f)), begin_s_(begin_s), end_s_(end_s) {
  const int steps = std::max(1, static_cast<int>(std::ceil((end_s - begin_s) / step_s)));
  std::vector<TimeSample> regular;
  for (int i = -1; i <= steps + 1; ++i) {
    const double t = begin_s + (end_s - begin_s) * i / steps;
    regular.push_back({t, f_(t)});
  }
  add_extremes(regular);
}

void SampledCurve::add_extremes(const std::vector<TimeSample>& regular) {
  samples_ = regular;
  for (size_t i = 1; i + 1 < regular.size(); ++i) {
    const double before = regular[i].value - regular[i - 1].value;
    const double after = regular[i + 1].value - regular[i].value;
    if (before * after > 0) continue;
    const double sign = before > 0 || after < 0 ? 1.0 : -1.0;
    samples_.push_back(extreme(f_, sign, regular[i - 1].time_s, regular[i + 1].time_s));
  }
  std::sort(samples_.begin(), samples_.end(),
            [](const TimeSample& a, const TimeSample& b) { return a.time_s < b.time_s; });
}

/// Regula falsi with the Illinois weighting, and a bisection whenever it stalls.
double SampledCurve::root(const TimeSample& a, const TimeSample& b, double level) const {
  double low = a.time_s, high = b.time_s;
  double f_low = a.value - level, f_high = b.value - level;
  int kept_side = 0;
  for (int i = 0; high - low > kTimeTolerance && i < 100; ++i) {
    const bool halve = i % 4 == 3;
    double t = halve ? 0.5 * (low + high) : (low * f_high - high * f_low) / (f_high - f_low);
    // Stay inside by half the tolerance: the far end closes in as soon as the root is met.
    t = std::clamp(t, low + kTimeTolerance / 2, high - kTimeTolerance / 2);
    const double f = f_(t) - level;
    if ((f < 0) == (f_low < 0)) {
      low = t, f_low = f;
      if (kept_side == 1) f_high /= 2;
      kept_side = 1;
    } else {
      high = t, f_high = f;
      if (kept_side == -1) f_low /= 2;
      kept_side = -1;
    }
  }
  return 0.5 * (low + high);
}

std::vector<SampledCurve::Crossing> SampledCurve::crossings(double level) const {
  std::vector<Crossing> found;
  for (size_t i = 0; i + 1 < samples_.size(); ++i) {
    const TimeSample& a = samples_[i];
    const TimeSample& b = samples_[i + 1];
    if ((a.value < level) == (b.value < level)) continue;
    const double t = root(a, b, level);
    if (t >= begin_s_ && t < end_s_) found.push_back({t, b.value > a.value});
  }
  return found;
}

}  // namespace skylapse::astro
