// Speed of the pixels of a sliced sky: wall time on all cores and on one, and how it grows with the
// number of pixels. The slice is made up: its numbers do not change the work.
//   bench_slice_image [--quick]
// Times are medians of several runs, with the fastest beside them.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "bruneton_image/slices.h"
#include "color/rgb_space.h"
#include "core/parallel.h"
#include "sky/bruneton/slice_image.h"
#include "sky/bruneton/slice_refine.h"

namespace {

using namespace skylapse;
using namespace skylapse::sky::bruneton;
using image::Camera;
using image::FrameBuffer;
using image::Projection;

struct Time {
  double median = 0, best = 0;
};

Time time_of(int runs, const std::function<void()>& work) {
  std::vector<double> ms;
  work();  // warm
  for (int run = 0; run < runs; ++run) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    ms.push_back(taken.count());
  }
  std::sort(ms.begin(), ms.end());
  return {ms[ms.size() / 2], ms.front()};
}

struct Case {
  std::string name;
  Camera camera;
  double height_km;
};

Camera camera_of(Projection projection, int width, int height, double fov_deg, double elevation) {
  Camera camera;
  camera.projection = projection;
  camera.width = width, camera.height = height;
  camera.field_of_view = fov_deg * deg;
  camera.camera_to_enu = image::look_at(200 * deg, elevation * deg, 0 * deg);
  return camera;
}

void report(const Case& c, int runs) {
  MadeUpSky sky = made_up_sky(c.height_km, 60, 200, 0.7);
  sky.slice = refined(sky.slice, {8, 12});  // 185 x 362: as large as a real frame's on the ground
  const SliceImageInputs inputs{&sky.slice, sky.sun, color::xyz_to_rgb(color::RgbSpace::rec709),
                                1.0};
  FrameBuffer out(c.camera.width, c.camera.height);
  const auto work = [&] { render_slice(c.camera, inputs, out); };
  const Time all = time_of(runs, work);
  const Time one = [&] {
    const ThreadLimit limit(1);
    return time_of(runs, work);
  }();
  const double pixels = double(c.camera.width) * c.camera.height;
  fmt::print("{:<34} {:>5} x {:<5} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f}\n", c.name, c.camera.width,
             c.camera.height, all.median, all.best, one.median, 1e6 * one.best / pixels);
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
  const int runs = quick ? 5 : 25;
  fmt::print("{} cores\n{:<34} {:>13} {:>9} {:>9} {:>9} {:>9}\n", available_cores(), "picture",
             "size", "all, ms", "best, ms", "one, ms", "one ns/px");
  using enum Projection;
  const std::vector<Case> cases{
      {"lat-long, ground", camera_of(lat_long, 2048, 1024, 0, 0), 0},
      {"lat-long, 400 km", camera_of(lat_long, 2048, 1024, 0, 0), 400},
      {"cube strip, ground", camera_of(cube, 1024, 6144, 0, 0), 0},
      {"cube strip, 36000 km", camera_of(cube, 1024, 6144, 0, 0), 36000},
      {"perspective 75 deg, ground", camera_of(perspective, 1920, 1080, 75, 15), 0},
      {"perspective 0.3 deg, 36000 km limb", camera_of(perspective, 1920, 1080, 0.3, -81.3), 36000},
      {"equidistant 180 deg, ground", camera_of(fisheye_equidistant, 1024, 1024, 180, 90), 0},
      {"equisolid 180 deg, ground", camera_of(fisheye_equisolid, 1024, 1024, 180, 90), 0},
      {"stereographic 180 deg, ground", camera_of(fisheye_stereographic, 1024, 1024, 180, 90), 0},
      {"lat-long, pixels / 16", camera_of(lat_long, 512, 256, 0, 0), 0},
      {"lat-long, pixels x 4", camera_of(lat_long, 4096, 2048, 0, 0), 0},
  };
  for (const Case& c : cases) report(c, runs);
  for (const auto& [azimuths, zeniths] : {std::pair{64, 128}, {128, 256}, {256, 256}}) {
    SkySlice slice;
    slice.grid = grid_at(0, azimuths, zeniths);
    for (int i = 0; i < azimuths * zeniths; ++i) {
      slice.smooth.emplace_back(float(1 + i % 7));
      slice.aerosol.emplace_back(float(1 + i % 5));
    }
    const Time time = time_of(runs, [&] { slice.sun_zenith_rad = refined(slice).grid.sky_bend; });
    fmt::print("refining a slice of {:3} x {:3}: {:.2f} ms, best {:.2f}\n", azimuths, zeniths,
               time.median, time.best);
  }
}
