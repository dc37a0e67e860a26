// Speed and noise of the path tracer: paths a second of one core (its processor time, so that a
// busy machine tells the same), and the standard error that a
// thousand paths leave, for all orders and for those beyond the first.
//
//   bench_reference [seconds of each measurement, default 0.5]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>

#include "core/parallel.h"
#include "sky/atmosphere/atmosphere.h"
#include "sky/monte_carlo/reference.h"

namespace {

using namespace skylapse;
using sky::atmosphere::Medium;
using sky::bruneton::Query;
using sky::monte_carlo::reference_answer;
using sky::monte_carlo::ReferenceOptions;

double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

struct Rate {
  double paths_per_second = 0;
  double error = 0;  // of a thousand paths, relative to all orders; mean over bands
};

/// Runs of one thread until the time is up; the fastest counts.
Rate measure(const Medium& medium, const Query& query, ReferenceOptions options, double seconds) {
  const ThreadLimit one(1);
  const auto all = reference_answer(medium, query, {.samples = 20000, .seed = 77});
  options.samples = 4096;
  Rate rate;
  const double end = processor_seconds() + seconds;
  do {
    const double start = processor_seconds();
    const auto answer = reference_answer(medium, query, options);
    const double taken = processor_seconds() - start;
    rate.paths_per_second = std::max(rate.paths_per_second, double(options.samples) / taken);
    rate.error = 0;
    for (size_t b = 0; b < medium.bands.size(); ++b)
      rate.error += answer.standard_error[b] / all.radiance[b] * std::sqrt(4.096) /
                    double(medium.bands.size());
  } while (processor_seconds() < end);
  return rate;
}

void print_medium(const char* name, const Medium& medium, double seconds) {
  fmt::print("\n{}: {} bands, one core\n", name, medium.bands.size());
  fmt::print("{:>5} {:>5} {:>8} | {:>12} {:>10} | {:>12} {:>10}\n", "sun", "view", "azimuth",
             "paths/s", "error 1k", "orders 2+", "error 1k");
  const struct {
    double sun, view, azimuth;
  } rays[] = {{0, 45, 0},    {60, 0, 0},  {60, 45, 90}, {60, 60, 3},  {60, 88, 90},
              {60, 80, 180}, {85, 80, 5}, {90, 85, 60}, {94, 60, 20}, {100, 80, 0}};
  for (const auto& ray : rays) {
    const Query query{1 * metre, ray.sun * deg, ray.view * deg, ray.azimuth * deg};
    const Rate all = measure(medium, query, {}, seconds);
    const Rate higher = measure(medium, query, {.min_order = 2}, seconds);
    fmt::print("{:5} {:5} {:8} | {:12.3e} {:9.2f}% | {:12.3e} {:9.2f}%\n", ray.sun, ray.view,
               ray.azimuth, all.paths_per_second, 100 * all.error, higher.paths_per_second,
               100 * higher.error);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 0.5;
  print_medium("reference medium", sky::atmosphere::reference_medium(), seconds);
  const auto air = sky::atmosphere::atmosphere_of({});
  if (!air) return 1;
  print_medium("default air", medium_at(*air, sky::atmosphere::band_edges(16)), seconds);
  return 0;
}
