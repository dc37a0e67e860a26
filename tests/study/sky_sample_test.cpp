#include "study/sky_sample.h"

#include <gtest/gtest.h>

#include <numbers>

namespace skylapse::study {
namespace {

double total(const std::vector<SkyDirection>& directions) {
  double sum = 0;
  for (const SkyDirection& d : directions) sum += d.solid_angle.in(sr);
  return sum;
}

TEST(SkySample, CellsCoverTheSkyOnceForAnySunAndHorizon) {
  for (const double sun : {-4.0, 5.0, 45.0, 63.0, 90.0})
    for (const double dip : {0.0, -3.2, -18.0})
      for (const Sampling sampling : {Sampling::full, Sampling::quick}) {
        SCOPED_TRACE(testing::Message() << "sun " << sun << " horizon " << dip);
        const SkyGeometry geometry{enu_direction(123.4 * deg, sun * deg), dip * deg};
        const auto points = sample_points(geometry, sampling);
        const double sky = 2 * std::numbers::pi * (1 - sin(dip * deg));
        // The last row of pixels may hold ground and is left out: 2/3 deg of the ring.
        const double row = 2 * std::numbers::pi * (2.0 / 3 * deg).in(rad);
        EXPECT_LE(total(directions_of(points, geometry, MapSize::large)), sky + 1e-9);
        EXPECT_GE(total(directions_of(points, geometry, MapSize::large)), sky - row);
        const double upper = 2 * std::numbers::pi;
        EXPECT_NEAR(total(directions_of(points_of_small_map(points), geometry, MapSize::small)),
                    upper, 1e-9);
      }
}

TEST(SkySample, PixelsLookAlongTheirDirectionsInBothMaps) {
  const SkyGeometry geometry{enu_direction(211 * deg, 20 * deg), {}};
  const image::Camera large = study_camera(geometry.sun), small = small_study_camera(geometry.sun);
  int shared = 0;
  for (const SamplePoint& p : sample_points(geometry, Sampling::full)) {
    const auto seen = *image::direction_at(large, {p.x + 0.5, p.y + 0.5});
    EXPECT_LT(separation(seen, p.toward).in(arcsec), 0.01);
    if (p.small_x < 0) continue;
    ++shared;
    const auto seen_small = *image::direction_at(small, {p.small_x + 0.5, p.small_y + 0.5});
    EXPECT_LT(separation(seen_small, p.toward).in(arcsec), 0.01);
  }
  EXPECT_GT(shared, 100);
}

TEST(SkySample, MirrorImagesAreAsFarFromTheSun) {
  const SkyGeometry geometry{enu_direction(77 * deg, 33 * deg), {}};
  const auto points = sample_points(geometry, Sampling::quick);
  const auto directions = directions_of(points, geometry, MapSize::large);
  ASSERT_EQ(directions.size(), 2 * points.size());
  for (size_t i = 0; i < directions.size(); i += 2) {
    const Angle a = separation(directions[i].toward, geometry.sun);
    const Angle b = separation(directions[i + 1].toward, geometry.sun);
    EXPECT_LT(abs(a - b).in(arcsec), 0.01);
  }
}

TEST(SkySample, AureoleIsSampledFinelyEvenAtTheHorizon) {
  for (const double sun : {0.0, 5.0, 63.0}) {
    const SkyGeometry geometry{enu_direction(10 * deg, sun * deg), {}};
    int close = 0;
    for (const SamplePoint& p : sample_points(geometry, Sampling::full))
      close += separation(p.toward, geometry.sun) < 5 * deg ? 1 : 0;
    // Of a sun on the horizon half of the circle is sky.
    EXPECT_GE(close, sun > 0 ? 10 : 5) << sun;
  }
}

}  // namespace
}  // namespace skylapse::study
