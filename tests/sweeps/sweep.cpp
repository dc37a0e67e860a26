#include "sweeps/sweep.h"

#include <algorithm>
#include <mutex>

#include "core/parallel.h"

namespace skylapse::sweeps {

void Finding::add(const Finding& other) {
  evaluations += other.evaluations;
  non_finite += other.non_finite;
  broken += other.broken;
  // Of equal errors the one that sorts first: the same whatever piece ended first.
  if (other.worst > worst || (other.worst == worst && other.where < where)) {
    worst = other.worst;
    where = other.where;
  }
  if (first_broken.empty() || (!other.first_broken.empty() && other.first_broken < first_broken))
    first_broken = other.first_broken;
}

/// SplitMix64 (Steele, Lea and Flood 2014).
uint64_t Draw::bits() {
  uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

double Draw::in(double low, double high) {
  const double even = low + (high - low) * unit();
  const double near = (high - low) * std::pow(10.0, -18 * unit());
  const double tiny = std::numeric_limits<double>::denorm_min() * double(1 + below(1000));
  double value = even;
  switch (below(16)) {
    case 0:
      return low;
    case 1:
      return high;
    case 2:
      value = std::nextafter(low, high);
      break;
    case 3:
      value = std::nextafter(high, low);
      break;
    case 4:
      value = low + near;
      break;
    case 5:
      value = high - near;
      break;
    case 6:
      value = below(2) == 0 ? near : -near;
      break;
    case 7:
      value = below(4) == 0 ? 0.0 : below(2) == 0 ? tiny : -tiny;
      break;
    default:
      break;
  }
  return value < low || value > high ? std::clamp(even, low, high) : value;
}

float Draw::float_in(float low, float high) { return std::clamp(float(in(low, high)), low, high); }

double Draw::magnitude(double low, double high) {
  const int end = below(16);
  if (end < 2) return end == 0 ? low : high;
  return std::clamp(low * std::pow(high / low, unit()), low, high);
}

Finding run(const Sweep& sweep, long count, uint64_t seed) {
  const auto draws = size_t(std::max(1.0, double(count) * sweep.share));
  Finding all;
  std::mutex mutex;
  parallel_for_ranges(draws, 256, [&](size_t begin, size_t end) {
    Finding part;
    Tally tally(part);
    for (size_t i = begin; i < end; ++i) {
      Draw draw(seed, i);
      sweep.once(draw, tally);
    }
    const std::lock_guard lock(mutex);
    all.add(part);
  });
  return all;
}

std::vector<Sweep> all_sweeps() {
  std::vector<Sweep> sweeps;
  add_text_sweeps(sweeps);
  add_air_sweeps(sweeps);
  add_sun_sweeps(sweeps);
  add_image_sweeps(sweeps);
  add_value_sweeps(sweeps);
  return sweeps;
}

}  // namespace skylapse::sweeps
