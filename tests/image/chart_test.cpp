#include "image/camera/chart.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "image/camera/fisheye.h"
#include "sample_cameras.h"

namespace skylapse::image {
namespace {

/// At its rim a full sphere's lens ends within the pixel, or squeezes it to nothing.
bool at_full_rim(const Camera& camera, PixelPosition p) {
  const bool full =
      camera.projection == Projection::mirror_ball || camera.field_of_view >= 360 * deg;
  return full && fisheye_radius_at(camera, p) > 0.9;
}

class EveryChart : public testing::TestWithParam<NamedCamera> {};
INSTANTIATE_TEST_SUITE_P(Chart, EveryChart, testing::ValuesIn(sample_cameras()),
                         [](const auto& param) { return param.param.name; });

TEST_P(EveryChart, ShowsWhatTheCameraShows) {
  const Camera& camera = GetParam().camera;
  for (const Chart& chart : charts(camera))
    for (int y = 0; y < camera.height; y += 3)
      for (int x = 0; x < camera.width; x += 3) {
        const PixelPosition p{x + 0.5, y + 0.5};
        if (chart.face && cube_face_at(camera, p) != chart.face) continue;
        if (chart.octant && octant_at(camera, p) != chart.octant) continue;
        const auto seen = direction_at(camera, p);
        ASSERT_EQ(seen.has_value(), fills_pixel(chart, x, y));
        if (!seen) continue;
        const auto sample = chart_sample(chart, p);
        ASSERT_LT(separation(*seen, to_enu(camera, sample->direction)).in(rad), 1e-12);
        if (at_full_rim(camera, p)) continue;
        // The density at the centre is the pixel's solid angle but for its curvature.
        const double omega = pixel_solid_angle(camera, x, y).in(sr);
        ASSERT_NEAR(sample->sr_per_pixel / omega, 1, 0.02) << x << ' ' << y;
      }
}

TEST_P(EveryChart, FootprintHoldsEveryCellWithinTheRadius) {
  const Camera& camera = GetParam().camera;
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> uniform;
  const CellGrid grid{2, 3};
  for (int k = 0; k < 12; ++k) {
    // Around a place of the picture, its edges included.
    const auto centre =
        direction_at(camera, {uniform(rng) * camera.width, uniform(rng) * camera.height});
    if (!centre) continue;
    const bool narrow = camera.field_of_view < 1 * deg;
    const Angle radius = (narrow ? 0.05 : 5.0) * uniform(rng) * deg;
    for (const Chart& chart : charts(camera)) {
      const auto f = footprint(chart, to_camera_frame(camera, *centre), radius, grid);
      std::set<std::pair<int64_t, int64_t>> cells;
      const int64_t turn = int64_t{camera.width} * grid.columns;
      const bool repeats = camera.projection == Projection::lat_long;
      for (const auto& span : f.spans)
        for (int64_t i = span.begin; i < span.end; ++i) {
          const int64_t column = repeats ? ((i % turn) + turn) % turn : i;
          ASSERT_TRUE(cells.emplace(span.row, column).second) << "twice";
        }
      for (int64_t row = 0; row < int64_t{camera.height} * grid.rows; ++row)
        for (int64_t column = 0; column < turn; ++column) {
          const PixelPosition p{(double(column) + 0.5) / grid.columns,
                                (double(row) + 0.5) / grid.rows};
          const auto d = direction_at(camera, p);
          if (!d || separation(*d, *centre) >= radius) continue;
          if (chart.face && cube_face_at(camera, p) != chart.face) continue;
          if (chart.octant && octant_at(camera, p) != chart.octant) continue;
          ASSERT_TRUE(cells.contains({row, column})) << p.x << ' ' << p.y;
        }
    }
  }
}

TEST_P(EveryChart, PixelExtentsSpanThePixelsSolidAngle) {
  const Camera& camera = GetParam().camera;
  for (int y = 1; y < camera.height; y += 7)
    for (int x = 1; x < camera.width; x += 7) {
      const auto d = direction_at(camera, {x + 0.5, y + 0.5});
      if (!d || at_full_rim(camera, {x + 0.5, y + 0.5})) continue;
      const auto extent = pixel_extent(camera, to_camera_frame(camera, *d), 0.01 * deg);
      const double omega = pixel_solid_angle(camera, x, y).in(sr);
      // The area lags at most a pixel behind at a fisheye's middle and rim.
      const bool inner = camera.projection == Projection::perspective ||
                         camera.projection == Projection::lat_long ||
                         camera.projection == Projection::octahedral;
      ASSERT_NEAR(extent.area.in(sr) / omega, 1, inner ? 0.05 : 0.6) << x << ' ' << y;
      ASSERT_GE(extent.x.in(rad)*extent.y.in(rad), 0.95 * omega);
    }
}

}  // namespace
}  // namespace skylapse::image
