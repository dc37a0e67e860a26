// Comparing two pictures in memory: the measures of compare(), and FLIP.
//   build/release/bin/bench_diff --benchmark_repetitions=5 --benchmark_report_aggregates_only=true
// The pictures are a clear sky with a disc and the same sky with noise of 2 %, so that nothing is
// equal and no piece can be left out. "/2" at the end is the number of threads.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <optional>

#include "core/parallel.h"
#include "image/diff/flip.h"
#include "image/diff/measure.h"

namespace skylapse::image {
namespace {

constexpr double kPi = 3.14159265358979323846;

enum class Kind { linear, display };

struct Pair {
  Picture a, b;
  SkyView view;
};

float tone(double v) { return float(std::floor(255 * std::pow(v / (1 + v), 1 / 2.2) + 0.5) / 255); }

/// Lat-long, 2 x 1; the sun 40 deg high.
Pair sky_pair(int height, Kind kind) {
  Pair pair;
  Picture& a = pair.a;
  a.width = 2 * height;
  a.height = height;
  a.channels = {"R", "G", "B"};
  a.display_referred = kind == Kind::display;
  a.samples.reserve(3 * a.pixel_count());
  const double per_pixel = kPi / height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const double elevation = kPi / 2 - (y + 0.5) * per_pixel;
      const double from_sun =
          std::hypot((x - 1.4 * height) * per_pixel, elevation - 40 * kPi / 180);
      const double disc = from_sun < 0.00465 ? 5000 : 0, glow = 6 / (1 + 400 * from_sun * from_sun);
      const double low = std::exp(-4 * std::fabs(elevation)), ground = elevation < 0 ? 0.15 : 1;
      for (const double v : {0.2 + 0.5 * low + glow + disc, 0.35 + 0.45 * low + 0.8 * glow + disc,
                             0.8 + 0.2 * low + 0.7 * glow + disc})
        a.samples.push_back(kind == Kind::display ? tone(ground * v) : float(ground * v));
    }
  pair.b = a;
  uint32_t state = 1;
  for (float& v : pair.b.samples) {
    state = 1664525 * state + 1013904223;
    const float noise = 0.04f * (float(state >> 8) / 16777216.0f - 0.5f);
    v *= 1 + noise;
    if (kind == Kind::display) v = std::round(255 * std::fmin(v, 1.0f)) / 255;
  }
  return pair;
}

void finish(benchmark::State& state, const Pair& pair) {
  state.counters["per_pixel"] = benchmark::Counter(
      double(pair.a.pixel_count()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// With a projection, camera and sun are known: every pixel has a direction, and regions.
void measures(benchmark::State& state, Kind kind, std::optional<Projection> projection) {
  Pair pair = sky_pair(int(state.range(0)), kind);
  if (projection) {
    pair.view.camera =
        Camera{.projection = *projection, .width = pair.a.width, .height = pair.a.height};
    pair.view.sun = direction_at(*pair.view.camera, {pair.a.width / 2.0, pair.a.height / 3.0});
  }
  const ThreadLimit limit(int(state.range(1)));
  for (auto _ : state) benchmark::DoNotOptimize(compare(pair.a, pair.b, pair.view));
  finish(state, pair);
}

void flip_of_display(benchmark::State& state) {
  const Pair pair = sky_pair(int(state.range(0)), Kind::display);
  const ThreadLimit limit(int(state.range(1)));
  for (auto _ : state) benchmark::DoNotOptimize(flip(pair.a, pair.b));
  finish(state, pair);
}

void flip_of_light(benchmark::State& state, ToneMapper mapper) {
  const Pair pair = sky_pair(int(state.range(0)), Kind::linear);
  const ThreadLimit limit(int(state.range(1)));
  FlipOptions options;
  options.tone_mapper = mapper;
  options.exposures = 6;
  for (auto _ : state) benchmark::DoNotOptimize(flip(pair.a, pair.b, options));
  finish(state, pair);
}

/// Pairs of a CI are equal, most of them.
void flip_of_equal_light(benchmark::State& state) {
  const Pair pair = sky_pair(int(state.range(0)), Kind::linear);
  const ThreadLimit limit(int(state.range(1)));
  FlipOptions options;
  options.exposures = 6;
  for (auto _ : state) benchmark::DoNotOptimize(flip(pair.a, pair.a, options));
  finish(state, pair);
}

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgsProduct({{256, 512, 1024, 2048}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();
}

void one_size(benchmark::internal::Benchmark* b) {
  b->ArgsProduct({{512}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK_CAPTURE(measures, linear, Kind::linear, std::nullopt)->Apply(one_size);
BENCHMARK_CAPTURE(measures, lat_long, Kind::linear, Projection::lat_long)->Apply(sizes);
BENCHMARK_CAPTURE(measures, fisheye, Kind::linear, Projection::fisheye_equidistant)
    ->Apply(one_size);
BENCHMARK_CAPTURE(measures, perspective, Kind::linear, Projection::perspective)->Apply(one_size);
BENCHMARK_CAPTURE(measures, display, Kind::display, std::nullopt)->Apply(one_size);
BENCHMARK(flip_of_display)->Apply(sizes);
BENCHMARK_CAPTURE(flip_of_light, aces, ToneMapper::aces)->Apply(sizes);
BENCHMARK_CAPTURE(flip_of_light, reinhard, ToneMapper::reinhard)->Apply(one_size);
BENCHMARK(flip_of_equal_light)->Apply(one_size);

}  // namespace
}  // namespace skylapse::image

BENCHMARK_MAIN();
