// Time and memory of the atmosphere's tables and slices on OpenGL, and their distance from the
// double-precision twin.
//   bench_atmosphere [--backend egl|osmesa] [--level NAME] [--bands N] [--runs N] [--twin]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <string>
#include <thread>

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
  for (const Level level : arguments.levels)
    for (const int bands : arguments.bands) measure_tables(*context, level, bands, arguments);
  for (const int bands : arguments.bands) measure_slices(context, bands, arguments);
  return 0;
}
