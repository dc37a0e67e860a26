// Tables of the suns that frames read against tables of all suns.
#include "economies.h"
#include "sky/bruneton/sun_range.h"

namespace skylapse::economies {
namespace {

Tables tables_of(const Context& context, const atmosphere::Medium& medium,
                 const Settings& settings) {
  return value_or_exit(precompute(*context, medium, settings));
}

void print_sun(const Context& context, const atmosphere::Medium& medium, const Settings& settings,
               const GpuModel& full, double sun, double height) {
  const Settings part =
      restricted_to(sun_range_for(medium, sun * deg, sun * deg, height * km), settings, medium);
  Tables tables;
  const Cost cost = cost_of(1, [&] { tables = tables_of(context, medium, part); });
  const GpuModel partial = value_or_exit(GpuModel::create(context, tables));
  const SliceGrid grid = slice_grid(medium, height * km, 32, 64);
  const Distance d = distance(value_or_exit(partial.slice(height * km, sun * deg, grid)),
                              value_or_exit(full.slice(height * km, sun * deg, grid)));
  fmt::print(" {:5g} | {:3g} | {:2} | {:2} | {:4.0f} | {:4.1f} | {:.1e} | {:.1e}\n", height, sun,
             part.suns, tables.orders, cost.cpu_ms, double(tables.bytes()) / 1e6, d.rms, d.worst);
  std::fflush(stdout);
}

}  // namespace

void partial_tables(const Context& context, int bands) {
  for (const double depth : {0.05, 0.5}) {
    const atmosphere::Medium medium = medium_of(bands, depth);
    const Settings settings = settings_for(Level::standard, medium);
    Tables tables;
    const Cost cost = cost_of(3, [&] { tables = tables_of(context, medium, settings); });
    fmt::print("aerosol depth {}, {} bands, all {} suns: {} orders, {:.0f} CPU-ms, {:.1f} MB\n",
               depth, bands, settings.suns, tables.orders, cost.cpu_ms,
               double(tables.bytes()) / 1e6);
    fmt::print(" km | sun zenith | suns | orders | CPU-ms | MB | rms | greatest error\n");
    const GpuModel full = value_or_exit(GpuModel::create(context, tables));
    for (const double height : {0.001, 10.0, 400.0})
      for (const double sun : {10.0, 40.0, 60.0, 70.0, 80.0, 85.0, 90.0, 94.0, 98.0, 102.0, 108.0})
        print_sun(context, medium, settings, full, sun, height);
  }
}

}  // namespace skylapse::economies
