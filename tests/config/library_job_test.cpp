// What good libraries mean.
#include <gtest/gtest.h>

#include "config/job_text.h"

namespace skylapse::config {
namespace {

using test::kSmallJob;
using test::with;

JobConfig job_of(const std::string& text) {
  auto job = parse_job(text, "job.yaml");
  EXPECT_TRUE(job.ok()) << test::error_of(text);
  return job.ok() ? *job : JobConfig{};
}

template <class Kind>
Kind output_of(const std::string& output, const std::string& camera = "{look_at: west}") {
  const JobConfig job =
      job_of(with(with(kSmallJob, "{image: sky.####.png}", output), "{look_at: west}", camera));
  return job.outputs.empty() ? Kind{} : std::get<Kind>(job.outputs.back());
}

Angle heading(const CameraConfig& view) {
  return azimuth(Direction<Enu>::from_vector(view.camera.camera_to_enu[2]));
}

TEST(LibraryJob, AnOutputWithoutKeysOfAViewHasNone) {
  EXPECT_FALSE(output_of<ImageOutput>("{image: a.####.exr}").own_view.has_value());
}

TEST(LibraryJob, SizeAloneIsTheJobsCameraInAnotherSize) {
  const auto image = output_of<ImageOutput>("{image: a.####.jpg, size: 64x36}",
                                            "{look_at: west, fov: 75 deg, size: 1280x720}");
  ASSERT_TRUE(image.own_view.has_value());
  EXPECT_EQ(image.own_view->camera.width, 64);
  EXPECT_EQ(image.own_view->camera.height, 36);
  EXPECT_NEAR(image.own_view->camera.field_of_view.in(deg), 75, 1e-12);
  EXPECT_NEAR(heading(*image.own_view).in(deg), 270, 1e-9);
}

TEST(LibraryJob, MapsOfTheirOwnAreCentredAsTheJobsMap) {
  const std::string camera = "{projection: lat-long, look_at: south, size: 64x32}";
  const auto cube =
      output_of<ImageOutput>("{image: a.####.exr, projection: cube, size: 16}", camera);
  EXPECT_NEAR(heading(*cube.own_view).in(deg), 180, 1e-9);
  const auto turned = output_of<ImageOutput>(
      "{image: a.####.exr, projection: cube, size: 16, look_at: east}", camera);
  EXPECT_NEAR(heading(*turned.own_view).in(deg), 90, 1e-9);
  const auto oriented = output_of<ImageOutput>(
      "{image: a.####.exr, projection: cube, size: 16, orientation: unreal}", camera);
  EXPECT_EQ(oriented.orientation, image::Orientation::unreal);
  EXPECT_NEAR(std::remainder(heading(*oriented.own_view).in(deg), 360), 0, 1e-9);
  // A job whose camera is no map leaves them centred on north.
  const auto plain = output_of<ImageOutput>("{image: a.####.exr, projection: lat-long}");
  EXPECT_NEAR(std::remainder(heading(*plain.own_view).in(deg), 360), 0, 1e-9);
}

TEST(LibraryJob, OneNumberIsASideOrTheWidthOfAMap) {
  const auto size = [](const std::string& view) {
    const auto camera =
        output_of<ImageOutput>("{image: a.####.exr, " + view + "}").own_view->camera;
    return std::pair(camera.width, camera.height);
  };
  EXPECT_EQ(size("projection: lat-long, size: 512"), std::pair(512, 256));
  EXPECT_EQ(size("projection: octahedral, size: 128"), std::pair(128, 128));
  EXPECT_EQ(size("projection: mirror-ball, size: 128"), std::pair(128, 128));
  EXPECT_EQ(size("projection: fisheye, size: 128"), std::pair(128, 128));
  EXPECT_EQ(size("projection: cube, size: 8, layout: vertical-cross"), std::pair(24, 32));
}

TEST(LibraryJob, SpecularLevelsEndAtFacesOfFourPixels) {
  const auto levels = [](const std::string& keys) {
    return output_of<ProductOutput>("{specular: a.####.ktx2" + keys + "}").levels;
  };
  EXPECT_EQ(levels(""), 7);  // 256 128 64 32 16 8 4
  EXPECT_EQ(levels(", size: 4"), 1);
  EXPECT_EQ(levels(", size: 1"), 1);
  EXPECT_EQ(levels(", size: 16, levels: 5"), 5);
  const auto apart = output_of<ProductOutput>("{specular: \"{level}{face}.####.exr\", size: 16}");
  EXPECT_TRUE(apart.view->cube_faces_apart);
  EXPECT_FALSE(output_of<ProductOutput>("{specular: \"{level}.####.exr\", size: 16}")
                   .view->cube_faces_apart);
}

TEST(LibraryJob, ProductsHaveTheDefaultsOfTheirFormats) {
  const auto map = output_of<ProductOutput>("{irradiance: a.####.exr}");
  EXPECT_EQ(map.view->camera.projection, image::Projection::lat_long);
  EXPECT_EQ(map.view->camera.height, 32);
  EXPECT_EQ(map.sample_type, output::SampleType::float32);
  EXPECT_TRUE(map.sun_disc);
  const auto cube = output_of<ProductOutput>("{irradiance: a.####.ktx2, size: 16, type: float}");
  EXPECT_EQ(cube.view->camera.projection, image::Projection::cube);
  EXPECT_EQ(cube.sample_type, output::SampleType::float32);
  EXPECT_EQ(output_of<ProductOutput>("{irradiance: a.####.hdr}").sample_type,
            output::SampleType::float32);
  EXPECT_EQ(output_of<ProductOutput>("{sun: a.####.json}").orientation,
            image::Orientation::openexr);
  EXPECT_EQ(output_of<ProductOutput>("{sun: a.####.usda}").orientation, image::Orientation::usd);
  EXPECT_FALSE(output_of<ProductOutput>("{harmonics: a.####.json, sun_disc: off}").sun_disc);
}

TEST(LibraryJob, WhatIsShownIsFoundByAnySpellingOfItsName) {
  const auto dome = output_of<ProductOutput>(
      "{image: a/sky.####.exr, projection: lat-long}, {dome: d.####.usda, map: ./a//sky.####.exr}");
  EXPECT_EQ(dome.map_path.value, "a/sky.####.exr");
  const auto sheet = output_of<LibraryOutput>(
      "{image: sky.####.png}, {sheet: s.jpeg, image: sky.####.png, columns: 3}");
  EXPECT_EQ(sheet.kind, LibraryKind::sheet);
  EXPECT_EQ(sheet.format, "jpg");
  EXPECT_EQ(sheet.columns, 3);
}

TEST(LibraryJob, TheSunIsKeptWholeWhereNumbersReach) {
  EXPECT_EQ(output_of<ImageOutput>("{image: a.####.exr, type: half}").sun_policy,
            output::SunPolicy::clip);
  EXPECT_EQ(output_of<ImageOutput>("{image: a.####.hdr}").sun_policy, output::SunPolicy::float32);
  EXPECT_EQ(output_of<ImageOutput>("{image: a.####.hdr, sun: scale}").sun_policy,
            output::SunPolicy::scale);
}

TEST(LibraryJob, ElevationsKeepTheirOrder) {
  const JobConfig job = job_of(with(
      with(kSmallJob, "step: 10 min", "sun_elevations: [30 deg, -4 deg, 5 deg], half: afternoon"),
      "sky.####.png", "\"{sun_elevation}.png\""));
  const auto& sampling = std::get<SunElevations>(job.time.sampling);
  ASSERT_EQ(sampling.elevations.size(), 3u);
  EXPECT_NEAR(sampling.elevations[1].in(deg), -4, 1e-12);
  EXPECT_EQ(sampling.half, SunElevations::Half::afternoon);
}

}  // namespace
}  // namespace skylapse::config
