// Accuracy against time of every sun algorithm, through the public functions only.
//
//   bench_sun [--quick]     a Markdown table on stdout
//
// Time: one-minute sequences of a day at one place, 30 days a run; median and spread of 15 runs.
// Error: largest angle from the ERFA path over 2000-2050 on a grid of places; the ERFA path itself
// is judged by tests/data/solar (JPL DE441) in test_astro.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "astro/ephemeris/celestial_nodes.h"
#include "astro/ephemeris/ephemeris.h"
#include "astro/events.h"

using namespace skylapse;
using namespace skylapse::astro;

namespace {

using Clock = std::chrono::steady_clock;

constexpr SunAlgorithm kAlgorithms[] = {SunAlgorithm::erfa, SunAlgorithm::sg2,
                                        SunAlgorithm::preetham_atan2, SunAlgorithm::preetham};
const GeodeticPosition kPrague{50.0755 * deg, 14.4378 * deg, 235.0 * metre};
volatile double g_sink = 0;

Instant start_of(int y) { return {.utc = std::chrono::sys_days{std::chrono::year{y} / 1 / 1}}; }

struct Timing {
  double median_ns = 0, low_ns = 0, high_ns = 0;
};

template <class Work>
Timing measure(int runs, int items, Work work) {
  std::vector<double> ns;
  for (int i = 0; i < runs; ++i) {
    const auto begin = Clock::now();
    work(i);
    ns.push_back(std::chrono::duration<double, std::nano>(Clock::now() - begin).count() / items);
  }
  std::sort(ns.begin(), ns.end());
  return {ns[ns.size() / 2], ns.front(), ns.back()};
}

/// A fresh month each run, so that no table of an earlier run helps.
Timing minute_sequence(SunAlgorithm algorithm) {
  const Ephemeris ephemeris({.algorithm = algorithm});
  constexpr int kMinutes = 30 * 1440;
  return measure(15, kMinutes, [&](int run) {
    const Instant begin = start_of(2026) + run * 30 * 24.0 * hour;
    double sum = 0;
    for (int m = 0; m < kMinutes; ++m)
      sum += ephemeris.sun_state(begin + m * 1.0 * minute, kPrague, {}).sun_apparent.z();
    g_sink = sum;
  });
}

/// Largest angles in degrees from the ERFA path, one entry an algorithm.
std::vector<double> largest_errors(double step_hours) {
  std::vector<Ephemeris> candidates;
  for (const SunAlgorithm a : kAlgorithms)
    candidates.emplace_back(EphemerisOptions{.algorithm = a});
  std::vector<double> largest(std::size(kAlgorithms), 0.0);
  for (Instant t = start_of(2000); t < start_of(2051); t = t + step_hours * hour)
    for (int lat = -90; lat <= 90; lat += 15)
      for (int lon = -180; lon < 180; lon += 40) {
        const GeodeticPosition p{lat * 1.0 * deg, lon * 1.0 * deg, 0.0 * metre};
        const Direction<Enu> truth = candidates[0].sun_state(t, p, {}).sun_true;
        for (size_t i = 1; i < candidates.size(); ++i)
          largest[i] = std::max(
              largest[i], separation(truth, candidates[i].sun_state(t, p, {}).sun_true).in(deg));
      }
  return largest;
}

/// What the hourly grid costs in accuracy: the largest change against direct evaluation.
double interpolation_error_arcsec() {
  CelestialNodes nodes;
  double largest = 0;
  for (double t = 0.0123; t < 51 * 365.25; t += 9.87) {
    const EarthState a = earth_state(t), b = nodes.at(t);
    largest = std::max({largest, std::hypot(a.pole_x - b.pole_x, a.pole_y - b.pole_y),
                        glm::length(a.heliocentric_position - b.heliocentric_position)});
  }
  return (largest * rad).in(arcsec);
}

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
  fmt::print("{}; GCC {}; one thread\n\n", cpu_name(), __VERSION__);
  const std::vector<double> errors = largest_errors(quick ? 997.3 : 99.73);
  fmt::print("| algorithm | ns a position (lowest..highest run) | largest error 2000-2050 |\n");
  fmt::print("|---|---|---|\n");
  for (size_t i = 0; i < std::size(kAlgorithms); ++i) {
    const Timing t = minute_sequence(kAlgorithms[i]);
    const std::string error = i == 0 ? "the judge; 0.014 arcsec against DE441 (test_astro)"
                                     : fmt::format("{:.4f} deg", errors[i]);
    fmt::print("| {} | {:.0f} ({:.0f}..{:.0f}) | {} |\n", name_of(kAlgorithms[i]), t.median_ns,
               t.low_ns, t.high_ns, error);
  }
  fmt::print("\ninterpolation between the hours changes the erfa path by at most {:.1e} arcsec\n",
             interpolation_error_arcsec());

  const Ephemeris ephemeris;
  const Zone zone = *Zone::find("+01:00");
  const Timing moon = measure(15, 1440, [&](int run) {
    const Instant begin = start_of(2026) + run * 24.0 * hour;
    for (int m = 0; m < 1440; ++m)
      g_sink = ephemeris.sky_state(begin + m * 1.0 * minute, kPrague, {}).moon_apparent.z();
  });
  const Timing events = measure(60, 1, [&](int run) {
    const std::chrono::sys_days date =
        std::chrono::sys_days{std::chrono::year{2026} / 1 / 1} + std::chrono::days{run};
    g_sink = day_events(ephemeris, kPrague, *zone.civil_day(date)).sun_elevation_max.in(deg);
  });
  fmt::print("sun and moon together: {:.0f} ns; all events of a day: {:.2f} ms\n", moon.median_ns,
             events.median_ns / 1e6);
}
