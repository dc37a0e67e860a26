// No steps while the sun sinks.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/parallel.h"
#include "sky/bruneton/physics.h"
#include "studies.h"

namespace skylapse::sky::bruneton {
namespace {

constexpr double kFrom = 10, kTo = -18, kStep = 0.02;

struct Worst {
  double bend = 0, at = 0;
  void add(double value, double elevation) {
    if (std::abs(value) > bend) bend = std::abs(value), at = elevation;
  }
};

struct Course {
  Worst above_12, below_12;  // of -12 degrees
  int rises = 0;
};

/// Second differences of log radiance along one direction, all bands.
Course course(const Twin& twin, const Query& view) {
  Course result;
  const size_t bands = twin.medium().bands.size();
  std::vector<double> last(bands), before(bands);
  int step = 0;
  for (double elevation = kFrom; elevation >= kTo; elevation -= kStep, ++step) {
    Query query = view;
    query.sun_zenith = (90 - elevation) * deg;
    const Answer answer = twin.answer(query);
    for (size_t b = 0; b < bands; ++b) {
      const double value = std::log(std::max(answer.radiance[b], 1e-300));
      if (step >= 2) {
        Worst& worst = elevation > -12 ? result.above_12 : result.below_12;
        worst.add(value - 2 * last[b] + before[b], elevation);
      }
      if (step >= 1 && elevation < -1 && value > last[b]) ++result.rises;
      before[b] = last[b];
      last[b] = value;
    }
  }
  return result;
}

}  // namespace

void study_twilight(Level level) {
  const atmosphere::Medium medium = atmosphere::reference_medium();
  const Twin twin = twin_of(medium, settings_for(level, medium));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Query> views;
  for (int i = 0; i < 200; ++i) {
    // A third near the horizon.
    const double zenith = i % 3 == 0 ? 90 - 10 * share(random) * share(random)
                                     : std::acos(share(random)) * 180 / text::PI;
    views.push_back({1 * metre, 0 * deg, zenith * deg, 180 * share(random) * deg});
  }
  std::vector<Course> courses(views.size());
  parallel_for_ranges(views.size(), 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) courses[i] = course(twin, views[i]);
  });
  Course total;
  for (const Course& one : courses) {
    total.above_12.add(one.above_12.bend, one.above_12.at);
    total.below_12.add(one.below_12.bend, one.below_12.at);
    total.rises += one.rises;
  }
  fmt::print(
      "200 directions, sun +10..-18 deg by 0.02: second difference of log radiance at most "
      "{:.2f} % (sun {:.2f}) down to -12, {:.2f} % (sun {:.2f}) below; rising steps below "
      "-1 deg: {}\n",
      100 * total.above_12.bend, total.above_12.at, 100 * total.below_12.bend, total.below_12.at,
      total.rises);
}

}  // namespace skylapse::sky::bruneton
