// A frame's slice, refined as frames have it, against direct marching.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sky/bruneton/physics.h"
#include "sky/bruneton/slice_refine.h"
#include "studies.h"

namespace skylapse::sky::bruneton {
namespace {

struct Quantiles {
  double median, p99, max;
};

Quantiles slice_error(const Twin& twin, Length height, Angle sun, int azimuths, int zeniths) {
  MarchSettings march;
  march.ground = true;
  const SliceGrid grid = azimuths > 0 ? slice_grid(twin.medium(), height, azimuths, zeniths)
                                      : slice_grid(twin.medium(), height);
  const SkySlice slice = refined(twin.slice(height, sun, grid, march));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<std::pair<double, double>> values;
  double brightest = 0;
  for (int i = 0; i < 600; ++i) {
    // Both sides of the horizon, a third of them near it.
    const double span = i % 2 == 0 ? grid.sky_span_rad : -grid.ground_span_rad;
    const double s = i % 3 == 0 ? 0.2 * share(random) : share(random);
    const Angle zenith = (grid.horizon_zenith_rad - span * s * s) * rad;
    const Angle azimuth = text::PI * share(random) * rad;
    const Answer answer = twin.answer({height, sun, zenith, azimuth}, march);
    values.push_back({slice.radiance_xyz(zenith, azimuth).y, answer.radiance[0]});
    brightest = std::max(brightest, values.back().second);
  }
  std::vector<double> errors;
  for (const auto& [value, truth] : values)
    if (truth > 1e-3 * brightest) errors.push_back(100 * std::abs(value / truth - 1));
  std::sort(errors.begin(), errors.end());
  return {errors[errors.size() / 2], errors[errors.size() * 99 / 100], errors.back()};
}

}  // namespace

void study_slices() {
  atmosphere::Medium medium = atmosphere::reference_medium();
  medium.bands = {medium.bands[1]};
  medium.bands[0].xyz_weight = {0, 1, 0};
  const Twin twin = twin_of(medium, settings_for(Level::low, medium));
  fmt::print(
      "median / 99th percentile / greatest error [%] of values above 0.1 % of the brightest\n");
  for (const double height : {0.001, 3.0, 11.0, 40.0, 400.0, 36000.0})
    for (const double sun : {30.0, 90.0, 96.0}) {
      fmt::print("{:7g} km sun {:3g}:", height, sun);
      for (const auto& [azimuths, zeniths] : {std::pair{0, 0}, {64, 128}, {96, 192}, {128, 256}}) {
        const Quantiles error = slice_error(twin, height * km, sun * deg, azimuths, zeniths);
        fmt::print("  {} {:.2f}/{:.2f}/{:.2f}",
                   azimuths > 0 ? fmt::format("{}x{}", azimuths, zeniths) : "default", error.median,
                   error.p99, error.max);
      }
      fmt::print("\n");
      std::fflush(stdout);
    }
}

}  // namespace skylapse::sky::bruneton
