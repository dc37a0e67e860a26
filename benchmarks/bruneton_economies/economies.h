#pragma once
// What bench_economies prints, one function each.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "sky/atmosphere/atmosphere.h"
#include "sky/bruneton/gpu_model.h"
#include "sky/bruneton/twin.h"

namespace skylapse::economies {

using namespace sky;
using namespace sky::bruneton;
using Context = std::shared_ptr<gpu::Context>;

template <class T>
T value_or_exit(Result<T> result) {
  if (result) return std::move(result).value();
  fmt::print(stderr, "{}\n", format_error(result.error()));
  std::exit(1);
}

/// Earth's standard air with this much aerosol (vertical optical depth at 550 nm).
inline atmosphere::Medium medium_of(int bands, double aerosol_depth = 0.1, double ozone_du = 300) {
  atmosphere::AirDescription air;
  air.aerosol_optical_depth = aerosol_depth;
  air.ozone_du = ozone_du;
  return atmosphere::medium_at(value_or_exit(atmosphere::atmosphere_of(air)),
                               atmosphere::band_edges(bands));
}

/// Medians over some runs: wall time, and CPU time of all threads [ms].
struct Cost {
  double wall_ms = 0, cpu_ms = 0;
};
template <class Work>
Cost cost_of(int runs, const Work& work) {
  std::vector<double> wall, cpu;
  for (int i = 0; i < runs; ++i) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu_start = std::clock();
    work();
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    wall.push_back(taken.count());
    cpu.push_back(1e3 * double(std::clock() - cpu_start) / CLOCKS_PER_SEC);
  }
  const auto median = [](std::vector<double>& v) {
    std::sort(v.begin(), v.end());
    return v[v.size() / 2];
  };
  return {median(wall), median(cpu)};
}

/// Relative distance of Y over directions spread evenly over the slice's part of the sphere, of
/// values above 0.1 % of the brightest: root mean square and greatest.
struct Distance {
  double rms = 0, worst = 0;
};
Distance distance(const SkySlice& slice, const SkySlice& truth);

void partial_tables(const Context& context, int bands);
void orders(const Context& context, int bands);
void steps(const Context& context, int bands);
void half_floats(const Context& context, int bands);
void components(const Context& context, int bands);
void windows(const Context& context, int bands);
void irradiance(const Context& context, int bands);

}  // namespace skylapse::economies
