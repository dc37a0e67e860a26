#pragma once
// Roots and extremes of a smooth function of time, for rise, set, transit and twilight.
#include <functional>
#include <vector>

#include "astro/time/instant.h"

namespace skylapse::astro {

/// A quantity along the day: seconds after some origin -> value.
using TimeFunction = std::function<double(double)>;

struct TimeSample {
  double time_s = 0;
  double value = 0;
};

/// A function sampled so densely that between two neighbours it runs one way.
///
/// Regular samples, one step beyond both ends, to which every local extreme between them is added
/// (located by golden-section search): a curve that only just touches a level is seen on both sides
/// of it. Needs a function without two extremes inside one step.
class SampledCurve {
 public:
  SampledCurve(TimeFunction f, double begin_s, double end_s, double step_s);

  struct Crossing {
    double time_s = 0;
    bool rising = false;
  };
  /// Times in [begin, end) at which the curve passes `level`, in order, to 0.1 ms.
  [[nodiscard]] std::vector<Crossing> crossings(double level) const;
  [[nodiscard]] const std::vector<TimeSample>& samples() const { return samples_; }
  [[nodiscard]] double value_at_begin() const { return f_(begin_s_); }

 private:
  [[nodiscard]] double root(const TimeSample& a, const TimeSample& b, double level) const;
  void add_extremes(const std::vector<TimeSample>& regular);

  TimeFunction f_;
  double begin_s_, end_s_;
  std::vector<TimeSample> samples_;
};

}  // namespace skylapse::astro
