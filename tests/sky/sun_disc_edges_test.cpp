// The sun disc where pictures end, join or degenerate, and while it moves.
#include <gtest/gtest.h>

#include <map>

#include "image/camera/chart.h"
#include "sky/sun_disc.h"
#include "sun_disc_cameras.h"

namespace skylapse::sky {
namespace {

using image::Camera;
using image::CubeLayout;
using image::look_at;
using enum image::Projection;

const glm::dmat3 kNorth = look_at({}, {}, {});
const glm::dmat3 kZenith = look_at(180 * deg, 90 * deg, {});

void expect_whole_disc(const Camera& camera, const SunDisc& sun, const std::string& what) {
  const auto projected = project_sun_disc(camera, sun);
  const auto reference = disc_energy(sun);
  std::map<std::pair<int, int>, int> times;
  for (const auto& [x, y, radiance] : projected.pixels) {
    ASSERT_EQ(++times[std::pair(x, y)], 1) << what;
    ASSERT_TRUE(x >= 0 && y >= 0 && x < camera.width && y < camera.height) << what;
    ASSERT_TRUE(std::isfinite(radiance.x) && radiance.x >= 0) << what;
  }
  EXPECT_NEAR(projected.energy.normal_irradiance.g / reference.normal_irradiance.g, 1, 1e-9)
      << what;
}

TEST(SunDiscJoins, CubeEdgesAndCornersKeepTheWholeDisc) {
  for (const int n : {1, 2, 16, 64, 256, 1024})
    for (const auto layout : {CubeLayout::vertical_strip, CubeLayout::cross}) {
      const bool cross = layout == CubeLayout::cross;
      const Camera camera{cube, cross ? 4 * n : n, cross ? 3 * n : 6 * n, {}, layout, kNorth};
      for (const double azimuth : {45.0, 44.99, 45.2, 135.0})
        for (const double el : {35.264, 35.0, 35.4, 10.0})
          expect_whole_disc(camera, test_sun(azimuth * deg, el * deg),
                            "cube of " + std::to_string(n));
    }
}

TEST(SunDiscJoins, SeamAndPolesOfALatLongMapKeepTheWholeDisc) {
  for (const int w : {1, 2, 7, 64, 333, 1024}) {
    const Camera camera{lat_long, w, std::max(1, w / 2), {}, {}, kNorth};
    for (const double azimuth : {180.0, 179.9, -179.99})
      expect_whole_disc(camera, test_sun(azimuth * deg, 20 * deg), "seam " + std::to_string(w));
    for (const double el : {89.5, 89.7334, 89.9, 90.0})
      expect_whole_disc(camera, test_sun(12 * deg, el * deg), "pole " + std::to_string(w));
  }
}

TEST(SunDiscJoins, FoldsAndCornersOfAnOctahedralMapKeepTheWholeDisc) {
  for (const int w : {1, 2, 3, 7, 64, 333, 1024}) {
    const Camera camera{octahedral, w, w, {}, {}, kNorth};
    for (const double azimuth : {0.0, 0.05, 90.0, 179.99, 45.0})
      for (const double el : {0.0, 0.1, 0.3, 40.0, 89.5, 89.9, 90.0})
        expect_whole_disc(camera, test_sun(azimuth * deg, el * deg), "fold " + std::to_string(w));
    // A disc below the level, as seen from a mountain: across the outer edges.
    SunDisc low = test_sun(90.02 * deg, -5 * deg);
    low.horizon = -7 * deg;
    expect_whole_disc(camera, low, "low " + std::to_string(w));
  }
}

TEST(SunDiscJoins, RimOfAMirrorBallKeepsTheWholeDisc) {
  for (const int w : {16, 128, 512}) {
    const Camera camera{mirror_ball, w, w, {}, {}, look_at(180 * deg, 30 * deg, {})};
    for (const double el : {30.0, 30.2, 30.27, 31.0})  // 30: behind the ball
      expect_whole_disc(camera, test_sun(180 * deg, el * deg), "rim " + std::to_string(w));
  }
}

TEST(SunDiscJoins, RimOfAFullSphereFisheyeKeepsTheWholeDisc) {
  for (const auto projection : {fisheye_equidistant, fisheye_equisolid})
    for (const int w : {16, 128, 512}) {
      const Camera camera{projection, w, w, 360 * deg, {}, look_at(0 * deg, -30 * deg, {})};
      for (const double el : {30.0, 30.2, 30.27, 31.0})  // 30: straight behind
        expect_whole_disc(camera, test_sun(180 * deg, el * deg), "rim " + std::to_string(w));
    }
}

TEST(SunDiscEdges, IsNotSeenBehindTheCameraOrBelowTheHorizon) {
  const Camera ahead{perspective, 64, 64, 90 * deg, {}, kNorth};
  EXPECT_TRUE(project_sun_disc(ahead, test_sun(180 * deg, 0 * deg)).pixels.empty());
  EXPECT_TRUE(project_sun_disc(ahead, test_sun(90 * deg, 10 * deg)).pixels.empty());
  EXPECT_TRUE(project_sun_disc(ahead, test_sun(45.5 * deg, 10 * deg)).pixels.empty());
  EXPECT_TRUE(project_sun_disc(ahead, test_sun(0 * deg, -0.267 * deg)).pixels.empty());
  const Camera narrow{fisheye_equisolid, 64, 64, 60 * deg, {}, kZenith};
  EXPECT_TRUE(project_sun_disc(narrow, test_sun(0 * deg, 59 * deg)).pixels.empty());
}

TEST(SunDiscEdges, OnePixelImagesTakeAllOfIt) {
  for (const auto& [projection, fov] : {std::pair{perspective, 60.0},
                                        {fisheye_equidistant, 180.0},
                                        {fisheye_equisolid, 120.0},
                                        {fisheye_stereographic, 180.0},
                                        {lat_long, 0.0}}) {
    const Camera camera{projection, 1, 1, fov * deg, {}, look_at(50 * deg, 20 * deg, {})};
    if (projection == lat_long) continue;  // stands upright: below
    expect_whole_disc(camera, test_sun(53 * deg, 21 * deg), "one pixel");
  }
  expect_whole_disc({lat_long, 1, 1, {}, {}, kNorth}, test_sun(53 * deg, 21 * deg), "one pixel");
}

/// The flux of the part of the disc inside the picture, by a fine grid over the disc.
glm::dvec3 visible_flux(const Camera& camera, const SunDisc& sun) {
  const int n = 500;
  const double s = sin(sun.radius);
  const glm::dvec3 c = sun.centre.vec();
  const glm::dvec3 a = glm::normalize(glm::cross(glm::dvec3{0, 0, 1}, c)), b = glm::cross(c, a);
  glm::dvec3 flux{0};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = (2 * i + 1.0) / n - 1, y = (2 * j + 1.0) / n - 1, q2 = x * x + y * y;
      if (q2 >= 1) continue;
      const double cosine = std::sqrt(1 - s * s * q2);
      const auto d = Direction<Enu>::from_vector(cosine * c + s * (x * a + y * b));
      if (d.z() < 0 || !position_of(camera, d)) continue;
      flux += 4 * s * s / (double(n) * n * cosine) * test_radiance(elevation(d), std::sqrt(1 - q2));
    }
  return flux;
}

TEST(SunDiscEdges, FrameCutsTheDiscAndItsEnergyAlike) {
  for (const int w : {64, 256, 2048}) {
    const std::vector<Camera> cameras{
        {perspective, w, w / 2, 60 * deg, {}, look_at(70 * deg, 10 * deg, 12 * deg)},
        {perspective, w, w / 2, 8 * deg, {}, look_at(70 * deg, 10 * deg, 12 * deg)},
        {fisheye_equidistant, w, w, 100 * deg, {}, look_at(70 * deg, 10 * deg, {})},
        {fisheye_stereographic, w, w, 140 * deg, {}, look_at(70 * deg, 40 * deg, {})},
    };
    for (const Camera& camera : cameras) {
      // Where the picture ends to the right of its middle, and near its corner.
      const image::PixelPosition right{double(w), 0.5 * camera.height};
      const image::PixelPosition corner{0.999 * w, 0.002 * camera.height};
      for (const auto& at : {right, corner}) {
        const auto edge = direction_at(camera, at);
        if (!edge) continue;
        for (const double offset : {-0.25, -0.1, 0.0, 0.13, 0.2}) {
          const SunDisc sun = test_sun(azimuth(*edge) + offset * deg, elevation(*edge));
          const glm::dvec3 expected = visible_flux(camera, sun);
          const glm::dvec3 energy = project_sun_disc(camera, sun).energy.normal_irradiance;
          const double whole = disc_energy(sun).normal_irradiance.g;
          // Cells are 1/16 of the radius: the soft limb at the cut and the grid's own 1/500.
          EXPECT_NEAR(energy.g / whole, expected.g / whole, 5e-3)
              << w << " projection " << int(camera.projection) << " offset " << offset;
        }
      }
    }
  }
}

TEST(SunDiscEdges, DiscLargerThanThePictureFillsIt) {
  const Camera camera{perspective, 160, 90, 0.2 * deg, {}, look_at(70 * deg, 10 * deg, {})};
  const SunDisc sun{enu_direction(70.05 * deg, 10 * deg), kTestRadius,
                    [](Angle, double) { return glm::dvec3{1}; }};
  const auto pixels = project_sun_disc(camera, sun).pixels;
  EXPECT_EQ(pixels.size(), 160U * 90U);
  for (const auto& [x, y, radiance] : pixels) ASSERT_NEAR(radiance.x, 1, 1e-3) << x << ' ' << y;
}

TEST(SunDiscEdges, WidePerspectivesCutTheDiscToo) {
  for (const double fov : {170.0, 178.0, 179.5}) {
    const Camera camera{perspective, 64, 16, fov * deg, {}, kNorth};
    const Angle edge = 0.5 * fov * deg;
    for (const double offset : {-0.1, 0.0, 0.1}) {
      const SunDisc sun = test_sun(edge + offset * deg, 0.01 * deg);
      const double whole = disc_energy(sun).normal_irradiance.g;
      const double energy = project_sun_disc(camera, sun).energy.normal_irradiance.g;
      EXPECT_NEAR(energy / whole, visible_flux(camera, sun).g / whole, 2e-2)
          << fov << ' ' << offset;
    }
  }
}

// ---- motion

struct Path {
  std::string name;
  Camera camera;
  double azimuth, elevation, azimuth_step, elevation_step;  // deg
};

std::vector<Path> paths(int w) {
  const auto strip = CubeLayout::vertical_strip;
  const glm::dmat3 tilted = look_at(95 * deg, 8 * deg, 10 * deg);
  const double s = 0.0015;
  return {
      {"lat-long rising", {lat_long, w, w / 2, {}, strip, kNorth}, 100, 0.02, s, s},
      {"lat-long seam", {lat_long, w, w / 2, {}, strip, kNorth}, 179.9, 40, 2 * s, s / 4},
      {"lat-long pole", {lat_long, w, w / 2, {}, strip, kNorth}, 90, 89.6, 0, 2 * s},
      {"cube edge", {cube, w / 4, w / 4 * 6, {}, strip, kNorth}, 44.8, 10, 2 * s, s},
      {"cube corner", {cube, w / 4, w / 4 * 6, {}, strip, kNorth}, 44.7, 35.15, 2 * s, s},
      {"octahedral axis", {octahedral, w, w, {}, strip, kNorth}, 89.9, 40, 2 * s, s},
      {"octahedral rising", {octahedral, w, w, {}, strip, kNorth}, 70, 0.02, s, s},
      {"octahedral zenith", {octahedral, w, w, {}, strip, kNorth}, 70, 89.8, 0, 2 * s},
      {"perspective rising", {perspective, w, w / 2, 75 * deg, strip, tilted}, 90, 0, s, s},
      {"perspective edge", {perspective, w, w / 2, 20 * deg, strip, tilted}, 84.6, 8, 2 * s, s},
      {"perspective large", {perspective, w, w / 2, 3 * deg, strip, tilted}, 94.5, 8, s, s},
      {"fisheye rising", {fisheye_equidistant, w, w, 180 * deg, strip, kZenith}, 77, 0, s, s},
      {"fisheye rim", {fisheye_equisolid, w, w, 120 * deg, strip, kZenith}, 77, 29.8, s, 2 * s},
  };
}

class MovingSun : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(SunDisc, MovingSun, testing::Values(64, 250, 700));

// A step of d moves an edge of width 2R over an area 4 R d at most on each side: of the disc's flux
// that is 8 d / (pi R), times the brightness in the middle over the mean. Whatever more changes
// between two steps is flicker.
TEST_P(MovingSun, ChangesThePictureByNoMoreThanItsStep) {
  for (const Path& path : paths(GetParam())) {
    std::map<std::pair<int, int>, double> last;
    for (int i = 0; i < 120; ++i) {
      const SunDisc sun = test_sun((path.azimuth + i * path.azimuth_step) * deg,
                                   (path.elevation + i * path.elevation_step) * deg);
      const double whole = disc_energy(sun).normal_irradiance.g;
      std::map<std::pair<int, int>, double> now;
      for (const auto& [x, y, radiance] : project_sun_disc(path.camera, sun).pixels)
        now[{x, y}] = radiance.g * pixel_solid_angle(path.camera, x, y).in(sr) / whole;
      double change = 0;
      for (const auto& [pixel, light] : now) change += std::abs(light - last[pixel]);
      for (const auto& [pixel, light] : last)
        if (!now.contains(pixel)) change += light;
      const double step = std::hypot(path.azimuth_step, path.elevation_step) / kTestRadius.in(deg);
      if (i > 0) {
        ASSERT_LT(change, 4 * step + 2e-3) << path.name << " at step " << i;
      }
      last = std::move(now);
    }
  }
}

}  // namespace
}  // namespace skylapse::sky
