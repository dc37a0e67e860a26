// Parts of slices, and the small slice that gives a frame's irradiance.
#include "economies.h"
#include "sky/bruneton/slice_image.h"
#include "sky/bruneton/slice_irradiance.h"
#include "sky/bruneton/slice_refine.h"
#include "sky/bruneton/slice_window.h"

namespace skylapse::economies {
namespace {

constexpr int kRuns = 15;

struct View {
  const char* name;
  image::Camera camera;
  Length height;
};

View view_of(const char* name, double fov_deg, double elevation_deg, Length height,
             image::Projection projection = image::Projection::perspective) {
  image::Camera camera{.projection = projection, .width = 1920, .height = 1080};
  camera.field_of_view = fov_deg * deg;
  camera.camera_to_enu = image::look_at(120 * deg, elevation_deg * deg, 0 * deg);
  return {name, camera, height};
}

int nodes(const SliceWindow& w) {
  return (w.azimuths.end - w.azimuths.begin) *
         (w.sky.end - w.sky.begin + w.ground.end - w.ground.begin);
}

}  // namespace

void windows(const Context& context, int bands) {
  const atmosphere::Medium medium = medium_of(bands);
  const GpuModel model = value_or_exit(GpuModel::create(
      context, value_or_exit(precompute(*context, medium, settings_for(Level::standard, medium)))));
  const View views[] = {
      {"lat-long", {.projection = image::Projection::lat_long, .width = 2048, .height = 1024}, {}},
      view_of("75 deg, level", 75, 0, 2 * metre),
      view_of("75 deg, up 15 deg", 75, 15, 2 * metre),
      view_of("60 deg, up 40 deg", 60, 40, 2 * metre),
      view_of("10 deg, up 10 deg", 10, 10, 2 * metre),
      view_of("fisheye 180 deg, up", 180, 90, 2 * metre, image::Projection::fisheye_equidistant),
      view_of("60 deg, level, 10 km", 60, 0, 10 * km),
      view_of("40 deg, down 20 deg, 400 km", 40, -20, 400 * km),
      view_of("40 deg, up 40 deg, 400 km", 40, 40, 400 * km)};
  fmt::print("{} bands: camera | nodes | share | CPU-ms, sun 60 | sun 96 | refining\n", bands);
  for (const View& view : views) {
    const SliceGrid grid = slice_grid(medium, view.height);
    const SliceWindow window = window_of(view.camera, grid, enu_direction(200 * deg, 30 * deg));
    SkySlice slice;
    const auto ms = [&](double sun) {
      return cost_of(kRuns,
                     [&] {
                       slice = value_or_exit(
                           model.slice(view.height, sun * deg, grid, {.window = window}));
                     })
          .cpu_ms;
    };
    const double day = ms(60), dusk = ms(96);
    const double refining = cost_of(kRuns, [&] { refined(slice); }).cpu_ms;
    fmt::print(" {:28} | {:5} | {:3.0f} % | {:5.1f} | {:5.1f} | {:4.1f}\n", view.name,
               nodes(window), 100.0 * nodes(window) / (grid.azimuths * grid.zeniths), day, dusk,
               refining);
  }
}

void irradiance(const Context& context, int bands) {
  fmt::print("{} bands: irradiance by the small slice over that of a slice of 128 x 384\n", bands);
  fmt::print(" aerosol | km | suns 0, 30, 60, 80, 88, 90, 92, 94, 96, 98, 102, 106\n");
  for (const double depth : {0.05, 0.5}) {
    const atmosphere::Medium medium = medium_of(bands, depth);
    const GpuModel model = value_or_exit(GpuModel::create(
        context,
        value_or_exit(precompute(*context, medium, settings_for(Level::standard, medium)))));
    for (const Length height : {2 * metre, 3 * km, 11 * km, 40 * km}) {
      fmt::print(" {:4} | {:6g}", depth, height.in(km));
      for (const double sun : {0., 30., 60., 80., 88., 90., 92., 94., 96., 98., 102., 106.}) {
        const auto light = [&](const SliceGrid& grid) {
          const SliceContent content{.ground = false, .window = irradiance_window(grid)};
          return horizontal_irradiance_xyz(
              refined(value_or_exit(model.slice(height, sun * deg, grid, content))));
        };
        const double best = light(slice_grid(medium, height, 128, 384)).y;
        fmt::print(" {:+.1e}", light(irradiance_grid(medium, height)).y / best - 1);
      }
      fmt::print("\n");
    }
    const SliceGrid small = irradiance_grid(medium, 2 * metre);
    const Cost cost = cost_of(kRuns, [&] {
      horizontal_irradiance_xyz(refined(value_or_exit(model.slice(
          2 * metre, 60 * deg, small, {.ground = false, .window = irradiance_window(small)}))));
    });
    fmt::print(" costs {:.1f} CPU-ms\n", cost.cpu_ms);
  }
}

}  // namespace skylapse::economies
