// The published precomputation beside ours, in one run on one machine: lookups, time, and errors of
// the scattering density and of the radiance against the path tracer.
//
//   published_bruneton [--full] [--orders 4] [--paths 40000]
//
// By default the published tables are an eighth of their size (half in r, mu and mu_s) and the cost
// of the published size is extrapolated: every loop over a texel is the same, so cost is linear in
// texels (--full shows it; minutes). Errors are those of the tables that were computed.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "published.h"
#include "sky/bruneton/march_lists.h"
#include "sky/bruneton/twin.h"
#include "sky/monte_carlo/path.h"
#include "sky/monte_carlo/reference.h"
#include "support/atmosphere_truth.h"

namespace {
using namespace skylapse;
using namespace skylapse::sky;
using published::Float4;

struct Times {
  double wall = 0, cpu = 0;
};

template <class Work>
Times timed(const Work& work) {
  const auto wall = std::chrono::steady_clock::now();
  const std::clock_t cpu = std::clock();
  work();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count(),
          double(std::clock() - cpu) / CLOCKS_PER_SEC};
}

/// A direction at a point, and what it should show there, per band.
struct Sample {
  double height_km, sun_deg, view_deg, azimuth_deg;
  std::vector<double> truth, error;

  [[nodiscard]] double mu() const { return std::cos(view_deg * deg.factor); }
  [[nodiscard]] double mu_s() const { return std::cos(sun_deg * deg.factor); }
  [[nodiscard]] double nu() const {
    return mu() * mu_s() + std::sin(view_deg * deg.factor) * std::sin(sun_deg * deg.factor) *
                               std::cos(azimuth_deg * deg.factor);
  }
};

/// The truth that stands in tests/data/atmosphere: radiance at 1 m.
std::vector<Sample> published_truth() {
  std::vector<Sample> samples;
  for (TruthRow& row : read_truth("multiple_scattering.tsv")) {
    if (samples.empty() || samples.back().truth.size() == 3)
      samples.push_back(
          {0.001, row["sun_zenith_deg"], row["view_zenith_deg"], row["azimuth_deg"], {}, {}});
    samples.back().truth.push_back(row["all"]);
    samples.back().error.push_back(row["all_error"]);
  }
  return samples;
}

/// Radiance at 1 m by our path tracer.
std::vector<Sample> traced_radiance(const atmosphere::Medium& medium, long paths) {
  std::vector<Sample> samples;
  for (const double sun : {30.0, 80.0, 87.0, 90.0, 93.0, 96.0})
    for (const auto& [view, azimuth] : {std::pair{0.0, 0.0},
                                        {60.0, 90.0},
                                        {80.0, 180.0},
                                        {85.0, 0.0},
                                        {88.0, 45.0},
                                        {89.5, 0.0}}) {
      const monte_carlo::ReferenceAnswer answer =
          monte_carlo::reference_answer(medium, {1 * metre, sun * deg, view * deg, azimuth * deg},
                                        {.samples = paths, .seed = 23});
      samples.push_back({0.001, sun, view, azimuth, answer.radiance, answer.standard_error});
    }
  return samples;
}

/// Light of orders 1 and up that is scattered at a point into a direction, per km: paths that start
/// with an event, less what the event sees of the sun itself.
std::vector<Sample> traced_density(const atmosphere::Medium& medium, long paths) {
  const monte_carlo::Optics optics(medium);
  std::vector<Sample> samples;
  for (const double height : {0.5, 5.0, 15.0, 30.0})
    for (const double sun : {30.0, 80.0, 90.0, 95.0})
      for (const auto& [view, azimuth] :
           {std::pair{20.0, 60.0}, {85.0, 10.0}, {88.0, 120.0}, {110.0, 170.0}, {150.0, 30.0}})
        samples.push_back({height, sun, view, azimuth, {}, {}});
  for (Sample& sample : samples) {
    const double sine = std::sin(sample.view_deg * deg.factor);
    const glm::dvec3 view(sine * std::cos(sample.azimuth_deg * deg.factor),
                          sine * std::sin(sample.azimuth_deg * deg.factor), sample.mu());
    const glm::dvec3 sun(std::sin(sample.sun_deg * deg.factor), 0, sample.mu_s());
    monte_carlo::Path path(optics, {});
    monte_carlo::PathRadiance found;
    std::vector<double> sum(size_t(optics.bands)), squares(size_t(optics.bands));
    for (long n = 0; n < paths; ++n) {
      monte_carlo::PathRandom random(31, uint64_t(n));
      const monte_carlo::Place place{sample.height_km, {0, 0, 1}};
      path.begin(place, view, sun, int(n % optics.bands), random, found);
      for (bool alive = path.scatter_at(place); alive;) alive = path.travel();
      for (size_t b = 0; b < sum.size(); ++b) {
        const double x = found.all[b] - found.order1[b];
        sum[b] += x, squares[b] += x * x;
      }
    }
    for (size_t b = 0; b < sum.size(); ++b) {
      const double mean = sum[b] / double(paths);
      sample.truth.push_back(mean);
      sample.error.push_back(
          std::sqrt(std::max(0.0, squares[b] / double(paths) - mean * mean) / double(paths - 1)));
    }
  }
  return samples;
}

/// Relative errors, the noise of the truth among them.
struct Errors {
  std::vector<double> relative;
  double noise = 0, sigmas = 0;

  void add(double value, double truth, double error) {
    relative.push_back(std::abs(value / truth - 1));
    noise += std::pow(error / truth, 2);
    sigmas += std::pow((value - truth) / error, 2);
  }
  [[nodiscard]] std::string text() {
    std::sort(relative.begin(), relative.end());
    double squares = 0;
    for (const double e : relative) squares += e * e;
    const double n = double(relative.size());
    return fmt::format("{:7.2f} {:8.2f} {:8.2f} {:8.2f} {:8.2f} {:8.1f}",
                       100 * relative[relative.size() / 2], 100 * relative[size_t(0.95 * (n - 1))],
                       100 * relative.back(), 100 * std::sqrt(squares / n),
                       100 * std::sqrt(noise / n), std::sqrt(sigmas / n));
  }
};

/// `value` maps a sample to its value per band.
template <class Value>
void print_errors(const std::string& what, const std::vector<Sample>& samples, const Value& value) {
  Errors errors;
  // Values above 0.1 % of the brightest of their sun and height count.
  for (const Sample& sample : samples) {
    const auto found = value(sample);
    for (size_t b = 0; b < sample.truth.size(); ++b) {
      double brightest = 0;
      for (const Sample& other : samples)
        if (other.height_km == sample.height_km && other.sun_deg == sample.sun_deg)
          brightest = std::max(brightest, other.truth[b]);
      if (sample.truth[b] > 1e-3 * brightest)
        errors.add(found[b], sample.truth[b], sample.error[b]);
    }
  }
  fmt::print("  {:<44} {}\n", what, errors.text());
}

struct Truths {
  std::vector<Sample> file, radiance, density;
};

/// All, the near half (sun up) and the far half apart: twilight hides the day's errors otherwise.
template <class Value>
void print_by_sun(const std::string& what, const std::vector<Sample>& samples, const Value& value) {
  std::vector<Sample> day, dusk;
  for (const Sample& sample : samples) (sample.sun_deg < 90 ? day : dusk).push_back(sample);
  print_errors(what + ", sun 30-87", day, value);
  print_errors(what + ", sun 90-96", dusk, value);
}

void print_header() {
  fmt::print("  {:<44} {:>7} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "error %", "median", "95 %", "max",
             "rms", "noise", "in se");
}

struct Cost {
  double lookups = 0;
  Times times;
};

Cost judge_published(const atmosphere::Medium& medium, const published::Sizes& sizes, int orders,
                     const Truths& truths) {
  std::unique_ptr<published::Model> model;
  const Times times =
      timed([&] { model = std::make_unique<published::Model>(medium, sizes, orders); });
  fmt::print(
      "\npublished scheme, {} x {} x {} x {} (r, mu, mu_s, nu), {} orders, float, {:.0f} MB\n",
      sizes.r, sizes.mu, sizes.mu_s, sizes.nu, orders, double(model->bytes()) / 1e6);
  fmt::print("  {:.1f} M lookups of 4-D tables, {:.1f} M of others; {:.1f} CPU-s, {:.1f} s\n",
             double(model->counts().scattering) / 1e6, double(model->counts().small_tables) / 1e6,
             times.cpu, times.wall);
  const auto geometry = [&](const Sample& s) {
    const published::Mapping& map = model->mapping();
    const double r = map.bottom + s.height_km;
    return published::Geometry{r, s.mu(), s.mu_s(), s.nu(), map.hits_ground(r, s.mu())};
  };
  const auto radiance = [&](const Sample& s) { return model->radiance(geometry(s)); };
  print_header();
  print_errors("radiance at 1 m, truth in tests/data", truths.file, radiance);
  print_by_sun("radiance at 1 m, path tracer", truths.radiance, radiance);
  print_by_sun("scattering density, path tracer", truths.density,
               [&](const Sample& s) { return model->density(geometry(s)); });
  return {double(model->counts().scattering), times};
}

Cost judge_ours(const atmosphere::Medium& medium, bruneton::Level level, const Truths& truths) {
  const bruneton::Settings settings = bruneton::settings_for(level, medium);
  auto tables = std::make_shared<bruneton::Tables>();
  const Times times = timed([&] { *tables = bruneton::precompute_twin(medium, settings); });
  const auto columns = bruneton::make_columns(medium);
  const bruneton::MarchLists lists = bruneton::march_lists(*columns, settings, settings.samples);
  // Each sample of each ray reads the source table once for every sun and azimuth, for every order
  // after the first of the table.
  const double lookups = double(lists.samples.size()) * settings.suns * settings.azimuths *
                         (tables->orders > 1 ? tables->orders - 1 : 0);
  fmt::print(
      "\nours (the twin in double), level {}: {} heights, {} suns, {} x {} directions, "
      "{} orders and a tail, {:.0f} MB\n",
      bruneton::name_of(level), settings.heights, settings.suns,
      settings.directions_up + settings.directions_down, settings.azimuths, tables->orders,
      double(tables->bytes()) / 1e6);
  fmt::print("  {:.1f} M lookups of the source table; {:.2f} CPU-s, {:.2f} s\n", lookups / 1e6,
             times.cpu, times.wall);
  const bruneton::Twin twin(tables);
  const auto radiance = [&](const Sample& s) {
    return twin.answer({s.height_km * km, s.sun_deg * deg, s.view_deg * deg, s.azimuth_deg * deg})
        .radiance;
  };
  bruneton::PhysicsData data = bruneton::physics_data(medium, settings, settings.samples);
  data.tables = tables.get();
  bruneton::Geometry text(data);
  const auto density = [&](const Sample& s) {
    const glm::dvec4 source =
        text.source_at(0, text.source_texel(s.height_km, s.mu(), s.mu_s(), s.nu()));
    std::vector<double> values;
    for (size_t b = 0; b < medium.bands.size(); ++b)
      values.push_back(
          source[int(b)] *
          (medium.bands[b].rayleigh_scattering_per_km * medium.rayleigh.at(s.height_km) +
           medium.bands[b].aerosol_scattering_per_km * medium.aerosol.at(s.height_km)));
    return values;
  };
  print_header();
  print_errors("radiance at 1 m, truth in tests/data", truths.file, radiance);
  print_by_sun("radiance at 1 m, path tracer", truths.radiance, radiance);
  print_by_sun("scattering density, path tracer", truths.density, density);
  return {lookups, times};
}

}  // namespace

int main(int argc, char** argv) {
  bool full = false;
  int orders = 4;
  long paths = 40000;
  for (int i = 1; i < argc; ++i) {
    const std::string key = argv[i];
    if (key == "--full")
      full = true;
    else if (key == "--orders" && i + 1 < argc)
      orders = std::max(1, std::stoi(argv[++i]));
    else if (key == "--paths" && i + 1 < argc)
      paths = std::max(1000L, std::stol(argv[++i]));
    else
      return fmt::print(stderr, "unknown option {}\n", key), 2;
  }
  const atmosphere::Medium medium = atmosphere::reference_medium();
  Truths truths{published_truth(), {}, {}};
  const Times truth = timed([&] {
    truths.radiance = traced_radiance(medium, paths);
    truths.density = traced_density(medium, paths);
  });
  fmt::print("reference medium, 3 wavelengths; truth by {} paths a value: {:.0f} s\n", paths,
             truth.wall);

  const published::Sizes published_sizes;
  published::Sizes sizes = published_sizes;
  if (!full) sizes.r /= 2, sizes.mu /= 2, sizes.mu_s /= 2;
  const Cost theirs = judge_published(medium, sizes, orders, truths);
  const Cost ours = judge_ours(medium, bruneton::Level::standard, truths);

  const double scale = double(published_sizes.texels()) / double(sizes.texels());
  fmt::print("\npublished size{}: {:.0f} M lookups, {:.0f} CPU-s, {:.1f} s\n",
             full ? "" : fmt::format(" (extrapolated, x {:g})", scale),
             scale * theirs.lookups / 1e6, scale * theirs.times.cpu, scale * theirs.times.wall);
  fmt::print("ours: 1/{:.0f} of the lookups, 1/{:.0f} of the CPU time, 1/{:.0f} of the wall time\n",
             scale * theirs.lookups / ours.lookups, scale * theirs.times.cpu / ours.times.cpu,
             scale * theirs.times.wall / ours.times.wall);
  return 0;
}
