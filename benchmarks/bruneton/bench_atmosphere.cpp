// Time and memory of the atmosphere's tables and slices on OpenGL, and their distance from the
// double-precision twin.
//   bench_atmosphere [--backend egl|osmesa] [--level NAME] [--bands N] [--runs N] [--twin]
//   bench_atmosphere --draws N [--seed S]: random single directions over the whole domain, on
//   OpenGL
//     and on the twin; counts what is not finite or not physical, and prints their distance
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <random>
#include <string>
#include <thread>

#include "core/parallel.h"
#include "sky/atmosphere/atmosphere.h"
#include "sky/bruneton/gpu_model.h"
#include "sky/bruneton/twin.h"

namespace {

using namespace skylapse;
using namespace skylapse::sky;
using namespace skylapse::sky::bruneton;

struct Arguments {
  gpu::Backend backend = gpu::Backend::automatic;
  std::vector<Level> levels{Level::draft, Level::low, Level::standard, Level::fine};
  std::vector<int> bands{4, 16};
  int runs = 5;
  bool twin = false;
  int draws = 0;
  unsigned seed = 1;
};

double cpu_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

struct Timing {
  std::vector<double> wall_ms, cpu_ms;
  template <class Work>
  void measure(const Work& work) {
    const double cpu = cpu_seconds();
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
    wall_ms.push_back(wall.count());
    cpu_ms.push_back(1e3 * (cpu_seconds() - cpu));
  }
  [[nodiscard]] std::string text() const {
    const auto median = [](std::vector<double> v) {
      std::sort(v.begin(), v.end());
      return v[v.size() / 2];
    };
    const auto [least, most] = std::minmax_element(wall_ms.begin(), wall_ms.end());
    return fmt::format("wall {:8.1f} ms ({:.1f} .. {:.1f}), CPU {:8.1f} ms", median(wall_ms),
                       *least, *most, median(cpu_ms));
  }
};

template <class T>
T value_or_exit(Result<T> result) {
  if (result) return std::move(result).value();
  fmt::print(stderr, "{}\n", format_error(result.error()));
  std::exit(1);
}

/// Distance of two tables relative to the brightest value at the same height and sun row: 99th
/// percentile and greatest.
std::string distance(const Tables& a, const Tables& b) {
  std::vector<double> errors;
  const size_t row = size_t(4) * a.settings.table_azimuths;
  for (size_t g = 0; g < a.source.size(); ++g)
    for (size_t first = 0; first + row <= a.source[g].size(); first += row) {
      double brightest = 0;
      for (size_t i = first; i < first + row; ++i)
        brightest = std::max(brightest, double(b.source[g][i]));
      for (size_t i = first; i < first + row && brightest > 1e-12; ++i)
        errors.push_back(std::abs(double(a.source[g][i]) - b.source[g][i]) / brightest);
    }
  std::sort(errors.begin(), errors.end());
  return fmt::format("median {:.2g}, p99 {:.2g}, max {:.2g}", errors[errors.size() / 2],
                     errors[errors.size() * 99 / 100], errors.back());
}

atmosphere::Medium medium_of(int bands) {
  const auto air = value_or_exit(atmosphere::atmosphere_of({}));
  return atmosphere::medium_at(air, atmosphere::band_edges(bands));
}

void measure_tables(gpu::Context& context, Level level, int bands, const Arguments& arguments) {
  const atmosphere::Medium medium = medium_of(bands);
  const Settings settings = settings_for(level, medium);
  Tables tables = value_or_exit(precompute(context, medium, settings));  // warms the shader cache
  Timing timing;
  for (int run = 0; run < arguments.runs; ++run)
    timing.measure([&] { tables = value_or_exit(precompute(context, medium, settings)); });
  fmt::print("precompute {:<8} {:2} bands: {}, {} orders, tables {:.1f} MB\n", name_of(level),
             bands, timing.text(), tables.orders, double(tables.bytes()) / 1e6);
  if (!arguments.twin) return;
  Tables twin;
  Timing twin_timing;
  twin_timing.measure([&] { twin = precompute_twin(medium, settings); });
  fmt::print("  twin in double: {}, {} orders; GL differs by {}\n", twin_timing.text(), twin.orders,
             distance(tables, twin));
}

/// Greatest distance relative to the brightest texel: of smooth and aerosol layer.
std::string distance(const SkySlice& a, const SkySlice& b) {
  double worst[2] = {0, 0};
  for (int layer = 0; layer < 2; ++layer) {
    const auto& x = layer == 0 ? a.smooth : a.aerosol;
    const auto& y = layer == 0 ? b.smooth : b.aerosol;
    float brightest = 0;
    for (const glm::vec4& texel : y) brightest = std::max(brightest, texel.y);
    for (size_t i = 0; i < y.size() && brightest > 0; ++i)
      worst[layer] = std::max(worst[layer], double(std::abs(x[i].y - y[i].y) / brightest));
  }
  return fmt::format("{:.1e} and {:.1e}", worst[0], worst[1]);
}

void measure_slices(const std::shared_ptr<gpu::Context>& context, int bands,
                    const Arguments& arguments) {
  const atmosphere::Medium medium = medium_of(bands);
  const auto tables = std::make_shared<const Tables>(
      value_or_exit(precompute(*context, medium, settings_for(Level::standard, medium))));
  Timing create;
  std::vector<GpuModel> models;
  create.measure([&] { models.push_back(value_or_exit(GpuModel::create(context, *tables))); });
  fmt::print("model of {} bands: {}\n", bands, create.text());
  const Twin twin(tables);
  for (const double height_km : {0.002, 10.0, 400.0})
    for (const double sun_deg : {30.0, 88.0, 98.0}) {
      const SliceGrid grid = slice_grid(medium, height_km * km, 64, 128);
      SkySlice slice = value_or_exit(models[0].slice(height_km * km, sun_deg * deg, grid));
      Timing timing;
      for (int run = 0; run < 4 * arguments.runs; ++run)
        timing.measure(
            [&] { slice = value_or_exit(models[0].slice(height_km * km, sun_deg * deg, grid)); });
      fmt::print("slice 64 x 128, {:2} bands, {:7.3f} km, sun {:3.0f} deg: {}\n", bands, height_km,
                 sun_deg, timing.text());
      if (arguments.twin) {
        const auto twin_slice = [&](int samples) {
          return twin.slice(height_km * km, sun_deg * deg, grid,
                            {.samples = samples, .multiple_scattering = true, .ground = true});
        };
        const SkySlice same = twin_slice(MarchSettings{}.samples), fine = twin_slice(64);
        fmt::print("  differs from the twin by {}; from 64 samples by {} (the twin itself by {})\n",
                   distance(slice, same), distance(slice, fine), distance(same, fine));
      }
    }
}

Query random_query(std::mt19937& random) {
  std::uniform_real_distribution<double> share(0, 1);
  const double u = share(random), v = share(random);
  const double height_km = u < 0.1 ? 0 : u < 0.6 ? 100 * v * v * v : 1e5 * v * v * v * v;
  return {height_km * km, 180 * share(random) * deg, 180 * share(random) * deg,
          360 * share(random) * deg};
}

size_t not_physical(const Answer& answer) {
  size_t wrong = 0;
  for (size_t b = 0; b < answer.radiance.size(); ++b)
    wrong += std::isfinite(answer.radiance[b]) && answer.radiance[b] >= 0 &&
                     answer.transmittance[b] >= 0 && answer.transmittance[b] <= 1 &&
                     answer.sun_transmittance[b] >= 0 && answer.sun_transmittance[b] <= 1
                 ? 0
                 : 1;
  return wrong;
}

/// Distances of radiances, relative to the twin's or to 1e-6 of a bright sky.
struct Draws {
  size_t count = 0, wrong_gl = 0, wrong_twin = 0;
  std::vector<float> errors{};

  void add(const Answer& gl, const Answer& twin) {
    ++count;
    wrong_gl += not_physical(gl);
    wrong_twin += not_physical(twin);
    constexpr double kBrightSky = 0.1;  // W m^-2 sr^-1 nm^-1
    for (size_t b = 0; b < twin.radiance.size(); ++b)
      errors.push_back(float(std::abs(gl.radiance[b] - twin.radiance[b]) /
                             std::max(twin.radiance[b], 1e-6 * kBrightSky)));
  }
};

void measure_draws(const std::shared_ptr<gpu::Context>& context, const Arguments& arguments) {
  const atmosphere::Medium medium = medium_of(3);
  const auto tables = std::make_shared<const Tables>(
      value_or_exit(precompute(*context, medium, settings_for(Level::draft, medium))));
  const GpuModel model = value_or_exit(GpuModel::create(context, *tables));
  const Twin twin(tables);
  std::mt19937 random(arguments.seed);
  Draws draws;
  while (draws.count < size_t(arguments.draws)) {
    std::vector<Query> queries(std::min<size_t>(1 << 15, arguments.draws - draws.count));
    for (Query& query : queries) query = random_query(random);
    const auto gl =
        value_or_exit(model.answer(queries, {.multiple_scattering = true, .ground = true}));
    std::vector<Answer> expected(queries.size());
    parallel_for_ranges(queries.size(), 16, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) expected[i] = twin.answer(queries[i], {.ground = true});
    });
    for (size_t i = 0; i < queries.size(); ++i) draws.add(gl[i], expected[i]);
  }
  std::sort(draws.errors.begin(), draws.errors.end());
  const auto share = [&](double p) {
    return draws.errors[size_t(p * double(draws.errors.size() - 1))];
  };
  fmt::print("{} draws (seed {}): not finite or not physical: OpenGL {}, twin {}\n", draws.count,
             arguments.seed, draws.wrong_gl, draws.wrong_twin);
  fmt::print("  distance of radiance: median {:.1e}, p99 {:.1e}, p99.99 {:.1e}, greatest {:.1e}\n",
             share(0.5), share(0.99), share(0.9999), draws.errors.back());
}

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i], value = i + 1 < argc ? argv[i + 1] : "";
    if (name == "--backend")
      arguments.backend = value == "osmesa" ? gpu::Backend::osmesa : gpu::Backend::egl;
    else if (name == "--level")
      std::erase_if(arguments.levels, [&](Level level) { return name_of(level) != value; });
    else if (name == "--bands")
      arguments.bands = {std::atoi(value.c_str())};
    else if (name == "--runs")
      arguments.runs = std::max(1, std::atoi(value.c_str()));
    else if (name == "--twin")
      arguments.twin = true;
    else if (name == "--draws")
      arguments.draws = std::atoi(value.c_str());
    else if (name == "--seed")
      arguments.seed = unsigned(std::atoi(value.c_str()));
  }
  return arguments;
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = parse(argc, argv);
  const auto context = value_or_exit(gpu::Context::create(arguments.backend));
  const gpu::ContextInfo& info = context->info();
  fmt::print("{}: {}, OpenGL {}, {} cores\n", info.backend, info.renderer, info.version,
             std::thread::hardware_concurrency());
  if (arguments.draws > 0) {
    measure_draws(context, arguments);
    return 0;
  }
  for (const Level level : arguments.levels)
    for (const int bands : arguments.bands) measure_tables(*context, level, bands, arguments);
  for (const int bands : arguments.bands) measure_slices(context, bands, arguments);
  return 0;
}
