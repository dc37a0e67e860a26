// Pictures from a part of a slice are those from all of it, to the bit.
#include "sky/bruneton/slice_window.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "bruneton/twins.h"
#include "sky/bruneton/slice_image.h"
#include "sky/bruneton/slice_refine.h"

namespace skylapse::sky::bruneton {
namespace {

using image::Camera;
using image::FrameBuffer;
using image::Projection;

const Twin& twin() {
  static const Twin made = make_twin(green_medium());
  return made;
}

constexpr MarchSettings kMarch{.samples = 2,
                               .ground = true};  // few: the parts matter, not the light

/// A height, a sun, and the whole slice of both.
struct Scene {
  Length height;
  Direction<Enu> sun;
  SkySlice slice;

  Scene(Length h, Angle sun_zenith, Angle sun_azimuth, int azimuths, int zeniths)
      : height(h),
        sun(enu_direction(sun_azimuth, 90 * deg - sun_zenith)),
        slice(twin().slice(h, sun_zenith, slice_grid(twin().medium(), h, azimuths, zeniths),
                           kMarch)) {}

  [[nodiscard]] SkySlice part(const SliceWindow& window) const {
    MarchSettings march = kMarch;
    march.window = window;
    return twin().slice(height, slice.sun_zenith_rad * rad, slice.grid, march);
  }
};

FrameBuffer picture(const Camera& camera, const SkySlice& slice, const Direction<Enu>& sun) {
  FrameBuffer out(camera.width, camera.height);
  const SkySlice fine = refined(slice);
  render_slice(camera, {.slice = &fine, .sun = sun}, out);
  return out;
}

double share_of(const SliceWindow& window, const SliceGrid& grid) {
  const auto size = [](const NodeRange& range) { return std::max(0, range.end - range.begin); };
  return double(size(window.azimuths)) * (size(window.sky) + size(window.ground)) /
         (double(grid.azimuths) * grid.zeniths);
}

bool same(const FrameBuffer& a, const FrameBuffer& b) {
  return a.data().size() == b.data().size() &&
         std::memcmp(a.data().data(), b.data().data(), a.data().size() * sizeof(float)) == 0;
}

/// Any projection with one lens, any direction and roll; fields of view from a hundredth of a
/// degree on, half of them small.
Camera random_camera(std::mt19937& random) {
  std::uniform_real_distribution<double> share(0, 1);
  Camera camera;
  const double kind = share(random);
  camera.projection = kind < 0.55   ? Projection::perspective
                      : kind < 0.7  ? Projection::fisheye_equidistant
                      : kind < 0.85 ? Projection::fisheye_equisolid
                                    : Projection::fisheye_stereographic;
  const double widest = camera.projection == Projection::perspective             ? 175
                        : camera.projection == Projection::fisheye_stereographic ? 330
                                                                                 : 360;
  const double wide = share(random);
  camera.field_of_view =
      (share(random) < 0.5 ? widest * wide : 40 * wide * wide) * deg + 0.01 * deg;
  camera.width = 1 + int(60 * share(random));
  camera.height = 1 + int(60 * share(random));
  // Straight up, straight down and along the horizon are cameras of their own.
  const double special = share(random);
  const Angle elevation = special < 0.08   ? 90 * deg
                          : special < 0.12 ? -90 * deg
                          : special < 0.25 ? 0 * deg
                                           : (180 * share(random) - 90) * deg;
  const double roll = share(random);
  camera.camera_to_enu =
      image::look_at(360 * share(random) * deg, elevation, roll < 0.4 ? 0 * deg : 360 * roll * deg);
  return camera;
}

TEST(SliceWindow, PicturesOfAnyCameraAreThoseOfTheWholeSliceToTheBit) {
  const std::vector<Scene> scenes{
      {0 * km, 30 * deg, 200 * deg, 24, 48},    {0.002 * km, 88 * deg, 10 * deg, 24, 64},
      {0 * km, 0 * deg, 0 * deg, 16, 32},       {11 * km, 96 * deg, 123 * deg, 24, 48},
      {99.9 * km, 60 * deg, 300 * deg, 16, 48}, {400 * km, 75 * deg, 250 * deg, 24, 48},
      {36000 * km, 100 * deg, 40 * deg, 32, 64}};
  std::mt19937 random(4);
  int narrow = 0;
  double saved = 0;
  constexpr int kCameras = 420;
  for (int i = 0; i < kCameras; ++i) {
    const Scene& scene = scenes[size_t(i) % scenes.size()];
    const Camera camera = random_camera(random);
    const SliceWindow window = window_of(camera, scene.slice.grid, scene.sun);
    const double share = share_of(window, scene.slice.grid);
    const FrameBuffer whole = picture(camera, scene.slice, scene.sun);
    const FrameBuffer part = picture(camera, scene.part(window), scene.sun);
    ASSERT_TRUE(same(whole, part)) << "camera " << i << ", window's share " << share;
    narrow += share < 0.2 ? 1 : 0;
    saved += (1 - share) / kCameras;
  }
  // Windows that are always whole would pass too.
  EXPECT_GT(narrow, kCameras / 10);
  EXPECT_GT(saved, 0.25);
}

TEST(SliceWindow, AWindowSmallerByOneNodeIsSeen) {
  const Scene scene(0 * km, 60 * deg, 0 * deg, 24, 48);
  Camera camera{.width = 40, .height = 30, .field_of_view = 50 * deg};
  camera.camera_to_enu = image::look_at(70 * deg, 40 * deg, 0 * deg);
  const SliceWindow window = window_of(camera, scene.slice.grid, scene.sun);
  ASSERT_TRUE(same(picture(camera, scene.slice, scene.sun),
                   picture(camera, scene.part(window), scene.sun)));
  // The margin for pixels and rounding is less than a node here: three nodes less must show.
  for (int NodeRange::*end : {&NodeRange::begin, &NodeRange::end})
    for (NodeRange SliceWindow::*axis : {&SliceWindow::sky, &SliceWindow::azimuths}) {
      SliceWindow less = window;
      (less.*axis).*end += end == &NodeRange::begin ? 3 : -3;
      EXPECT_FALSE(same(picture(camera, scene.slice, scene.sun),
                        picture(camera, scene.part(less), scene.sun)));
    }
}

TEST(SliceWindow, ACameraThatLooksAwayFromTheAirNeedsNothing) {
  const SliceGrid grid = slice_grid(twin().medium(), 400 * km);
  Camera camera{.width = 64, .height = 48, .field_of_view = 60 * deg};
  camera.camera_to_enu = image::look_at(0 * deg, 45 * deg, 0 * deg);
  EXPECT_TRUE(window_of(camera, grid, enu_direction(0 * deg, 30 * deg)).empty());
  camera.camera_to_enu = image::look_at(0 * deg, 0 * deg, 0 * deg);
  EXPECT_FALSE(window_of(camera, grid, enu_direction(0 * deg, 30 * deg)).empty());
  // Inside the air there is no such direction.
  const SliceGrid inside = slice_grid(twin().medium(), 50 * km);
  camera.camera_to_enu = image::look_at(0 * deg, 90 * deg, 0 * deg);
  EXPECT_FALSE(window_of(camera, inside, enu_direction(0 * deg, 30 * deg)).empty());
}

TEST(SliceWindow, ACameraAboveTheHorizonLeavesTheGround) {
  const SliceGrid grid = slice_grid(twin().medium(), 2 * metre);
  Camera camera{.width = 640, .height = 360, .field_of_view = 60 * deg};
  camera.camera_to_enu = image::look_at(0 * deg, 30 * deg, 0 * deg);
  const SliceWindow window = window_of(camera, grid, enu_direction(90 * deg, 30 * deg));
  EXPECT_TRUE(window.ground.empty());
  EXPECT_LT(share_of(window, grid), 0.3);
}

TEST(SliceWindow, MapsAndCubesNeedAll) {
  const SliceGrid grid = slice_grid(twin().medium(), 2 * metre);
  for (const Projection projection : {Projection::lat_long, Projection::cube})
    EXPECT_EQ(window_of({.projection = projection, .width = 64, .height = 384}, grid,
                        enu_direction(0 * deg, 30 * deg)),
              whole_window(grid));
}

}  // namespace
}  // namespace skylapse::sky::bruneton
