// Tables of a part of the suns against full ones: error by how far they reach beyond the frames'
// suns, and the time they take.
#include "economies.h"
#include "sky/bruneton/sun_range.h"

namespace skylapse::economies {
namespace {

const std::vector<double> kHeights{0.001, 10, 400};
const std::vector<double> kMargins{0, 2, 4, 6, 8, 12, 16, 24};

}  // namespace

void partial_tables(const Context& context) {
  for (const double depth : {0.05, 0.5}) {
    const atmosphere::Medium medium = medium_of(4, depth);
    const Settings settings = settings_for(Level::standard, medium);
    const Tables full = value_or_exit(precompute(*context, medium, settings));
    const GpuModel model = value_or_exit(GpuModel::create(context, full));
    for (const double sun : {10.0, 40.0, 70.0, 80.0, 85.0, 90.0, 94.0, 98.0, 102.0, 108.0}) {
      Settings last;
      for (const double margin : kMargins) {
        const Settings part = restricted_to(
            {std::max(0.0, sun - margin) * deg, (sun + margin) * deg}, settings, medium);
        Tables tables;
        if (part.suns == last.suns && part.first_sun == last.first_sun) continue;
        last = part;
        const Cost cost =
            cost_of(1, [&] { tables = value_or_exit(precompute(*context, medium, part)); });
        const GpuModel partial = value_or_exit(GpuModel::create(context, tables));
        fmt::print(
            "aerosol {:4.2f} sun {:5.1f} margin {:4.1f}: {:2} of {} suns, {:2} orders, {:5.0f} "
            "CPU-ms",
            depth, sun, margin, part.suns, settings.suns, tables.orders, cost.cpu_ms);
        for (const double height : kHeights) {
          const SliceGrid grid = slice_grid(medium, height * km, 32, 64);
          const Distance d = distance(value_or_exit(partial.slice(height * km, sun * deg, grid)),
                                      value_or_exit(model.slice(height * km, sun * deg, grid)));
          fmt::print(" | {:7g} km rms {:.1e} max {:.1e}", height, d.rms, d.worst);
        }
        fmt::print("\n");
        std::fflush(stdout);
      }
    }
  }
}

}  // namespace skylapse::economies
