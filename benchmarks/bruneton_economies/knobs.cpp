// Orders, steps, half floats, components left out: time and distance from the best.
#include "economies.h"
#include "sky/bruneton/half_source.h"

namespace skylapse::economies {
namespace {

constexpr int kRuns = 7;
const std::vector<double> kSuns{30, 80, 92, 98, 106};

std::string errors_text(const GpuModel& model, const GpuModel& best, const SliceGrid& grid,
                        Length height) {
  std::string text;
  for (const double sun : kSuns) {
    const Distance d = distance(value_or_exit(model.slice(height, sun * deg, grid)),
                                value_or_exit(best.slice(height, sun * deg, grid)));
    text += fmt::format(" | {:.1e} / {:.1e}", d.rms, d.worst);
  }
  return text;
}

double slice_ms(const GpuModel& model, const SliceGrid& grid, Length height, double sun) {
  return cost_of(kRuns, [&] { value_or_exit(model.slice(height, sun * deg, grid)); }).cpu_ms;
}

}  // namespace

void orders(const Context& context, int bands) {
  const Length height = 2 * metre;
  for (const double depth : {0.05, 0.5}) {
    const atmosphere::Medium medium = medium_of(bands, depth);
    const SliceGrid grid = slice_grid(medium, height, 32, 64);
    Settings settings = settings_for(Level::standard, medium);
    settings.stop_below = 1e-4;
    const GpuModel best = value_or_exit(
        GpuModel::create(context, value_or_exit(precompute(*context, medium, settings))));
    fmt::print(
        "aerosol depth {}, {} bands: orders | CPU-ms of the tables | rms / greatest error at "
        "suns 30, 80, 92, 98, 106 deg from the zenith\n",
        depth, bands);
    for (const int count : {1, 2, 3, 4, 6, 8, 0}) {
      settings = settings_for(Level::standard, medium);
      settings.orders = count;
      Tables tables;
      tables.medium = medium;
      const Cost cost = count == 1 ? Cost{} : cost_of(3, [&] {
        tables = value_or_exit(precompute(*context, medium, settings));
      });
      const GpuModel model = value_or_exit(GpuModel::create(context, tables));
      fmt::print(" {} | {:5.0f}{}\n",
                 count == 0 ? fmt::format("{} and a tail", tables.orders) : std::to_string(count),
                 cost.cpu_ms, errors_text(model, best, grid, height));
    }
  }
}

void steps(const Context& context, int bands) {
  const atmosphere::Medium medium = medium_of(bands);
  const Tables tables =
      value_or_exit(precompute(*context, medium, settings_for(Level::standard, medium)));
  const GpuModel best = value_or_exit(GpuModel::create(context, tables, {.samples = 64}));
  for (const double height : {0.002, 10.0}) {
    const SliceGrid grid = slice_grid(medium, height * km);
    fmt::print(
        "{} km, {} bands: steps | CPU-ms of a slice, suns 30 and 98 | rms / greatest error at "
        "suns 30, 80, 92, 98, 106 deg from the zenith\n",
        height, bands);
    for (const int count : {2, 4, 8, 16, 32}) {
      const GpuModel model = value_or_exit(GpuModel::create(context, tables, {.samples = count}));
      fmt::print(" {:2} | {:5.1f}, {:5.1f}{}\n", count, slice_ms(model, grid, height * km, 30),
                 slice_ms(model, grid, height * km, 98),
                 errors_text(model, best, grid, height * km));
    }
  }
}

void half_floats(const Context& context, int bands) {
  const Length height = 2 * metre;
  const atmosphere::Medium medium = medium_of(bands);
  const Tables tables =
      value_or_exit(precompute(*context, medium, settings_for(Level::standard, medium)));
  const SliceGrid grid = slice_grid(medium, height);
  const GpuModel best = value_or_exit(GpuModel::create(context, tables));
  fmt::print(
      "{} bands: tables | MB on the context | CPU-ms to make the model | CPU-ms of a slice, "
      "suns 30 and 98 | rms / greatest error at suns 30, 80, 92, 98, 106\n",
      bands);
  for (const bool half : {false, true}) {
    std::vector<GpuModel> models;
    const Cost make = cost_of(3, [&] {
      models = {value_or_exit(GpuModel::create(context, tables, {.half_source = half}))};
    });
    fmt::print(" {} | {:5.1f} | {:4.0f} | {:5.1f}, {:5.1f}{}\n", half ? "half" : "float",
               double(tables.bytes()) / (half ? 2e6 : 1e6), make.cpu_ms,
               slice_ms(models[0], grid, height, 30), slice_ms(models[0], grid, height, 98),
               errors_text(models[0], best, grid, height));
  }
}

void components(const Context& context, int bands) {
  fmt::print("{} bands: air | CPU-ms of the tables | of a slice, suns 30 and 98\n", bands);
  const struct {
    const char* name;
    double aerosol, ozone;
  } airs[] = {{"all", 0.1, 300}, {"no ozone", 0.1, 0}, {"no aerosol", 0, 300}, {"neither", 0, 0}};
  for (const auto& air : airs) {
    const atmosphere::Medium medium = medium_of(bands, air.aerosol, air.ozone);
    Tables tables;
    const Cost cost = cost_of(3, [&] {
      tables = value_or_exit(precompute(*context, medium, settings_for(Level::standard, medium)));
    });
    const GpuModel model = value_or_exit(GpuModel::create(context, tables));
    const SliceGrid grid = slice_grid(medium, 2 * metre);
    fmt::print(" {:10} | {:5.0f} | {:5.1f}, {:5.1f}\n", air.name, cost.cpu_ms,
               slice_ms(model, grid, 2 * metre, 30), slice_ms(model, grid, 2 * metre, 98));
  }
}

}  // namespace skylapse::economies
