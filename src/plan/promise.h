#pragma once
// What sky.accuracy or sky.time_budget led to: part of a plan.
#include <optional>
#include <string>
#include <vector>

#include "core/quantity.h"

namespace skylapse::plan {

/// A way of computing the job's sky, with what it is good for and what it costs.
struct Outlook {
  std::string name;
  /// Bound on the rms relative error of the sky of the job's worst picture.
  double error = 0;
  /// Of one core for a frame on average: sky, picture, files and its share of the tables. Within
  /// a factor of 2 on the machine of the benchmarks; others differ by their speed.
  double core_seconds = 0;
};

/// What was asked, what is taken, and what stood beside it.
struct Promise {
  std::optional<double> accuracy;       // share
  std::optional<Duration> time_budget;  // one of the two
  Outlook taken;
  bool kept = true;                    // false: nothing fits the budget, and the cheapest is taken
  std::string worst_picture;           // where the error of what is taken is greatest
  std::optional<Outlook> next_better;  // the cheapest with a smaller error than what is taken
  std::vector<Outlook> ladder;         // all that the scene admits, cheapest first
};

/// Lines for people: what is taken, its error and time, the next better.
std::string promise_text(const Promise& promise);

}  // namespace skylapse::plan
