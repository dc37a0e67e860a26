#include "sky/bruneton/slice_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "bruneton_image/slices.h"
#include "color/rgb_space.h"
#include "core/parallel.h"
#include "sky/bruneton/slice_irradiance.h"

namespace skylapse::sky::bruneton {
namespace {

using image::Camera;
using image::FrameBuffer;
using image::Projection;

SliceImageInputs inputs_of(const MadeUpSky& sky, const glm::dmat3& matrix = glm::dmat3(1.0)) {
  return {.slice = &sky.slice, .sun = sky.sun, .xyz_to_rgb = matrix};
}

/// The slice's radiance in the image's space, `over` the horizon at an azimuth.
struct Judge {
  const SliceImageInputs& in;

  [[nodiscard]] glm::dvec3 at(double over, double azimuth) const {
    return in.scale * (in.xyz_to_rgb * looked_up(*in.slice, over, azimuth));
  }
};

struct View {
  double over, azimuth;  // over the horizon, from the sun [rad]
};

View view_of(const Direction<Enu>& view, const MadeUpSky& sky) {
  const double h = sky.slice.grid.horizon_zenith_rad;
  const double level = std::hypot(view.x(), view.y());
  const double over = std::atan2(view.z() * std::sin(h) - level * std::cos(h),
                                 view.z() * std::cos(h) + level * std::sin(h));
  const double sun_level = std::hypot(sky.sun.x(), sky.sun.y());
  const glm::dvec2 to_sun =
      sun_level > 0 ? glm::dvec2(sky.sun.x(), sky.sun.y()) / sun_level : glm::dvec2(0, 1);
  const double along = view.x() * to_sun.x + view.y() * to_sun.y;
  const double across = view.x() * to_sun.y - view.y() * to_sun.x;
  return {over, std::atan2(std::abs(across), along)};
}

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

struct Errors {
  size_t samples = 0;
  double worst = 0;
  bool finite = true;
};

/// Height of a pixel as slice_image.h takes it.
double side_of(const Camera& camera, int x, int y) {
  if (camera.projection == Projection::lat_long) return kPi / camera.height;
  return std::sqrt(image::pixel_solid_angle(camera, x, y).in(sr));
}

/// Pixels whose value is that of their centre against the double lookup.
void compare(const Camera& camera, const MadeUpSky& sky, const glm::dmat3& matrix, Errors& errors) {
  const SliceImageInputs in = inputs_of(sky, matrix);
  FrameBuffer picture(camera.width, camera.height);
  render_slice(camera, in, picture);
  const Judge judge{in};
  const double floor = 1e-7 * largest(judge.at(1e-9, 0));
  for (int y = 0; y < camera.height; ++y)
    for (int x = y % 2; x < camera.width; x += 2) {
      const auto direction = image::direction_at(camera, {x + 0.5, y + 0.5});
      glm::dvec3 expected(0);
      if (direction) {
        const View view = view_of(*direction, sky);
        const double side = side_of(camera, x, y);
        if (std::abs(view.over) < 1.001 * kMeanPixels * side) continue;
        expected = glm::max(judge.at(view.over, view.azimuth), 0.0);
      }
      for (int c = 0; c < 3; ++c) {
        const double value = picture.pixel(x, y)[c];
        errors.finite = errors.finite && std::isfinite(value) && value >= 0;
        const double error = std::abs(value - expected[c]) / std::max(largest(expected), floor);
        ++errors.samples;
        errors.worst = std::max(errors.worst, error);
      }
    }
}

Camera camera_of(Projection projection, int width, int height, double fov_deg, double azimuth,
                 double elevation, double roll = 0) {
  Camera camera;
  camera.projection = projection;
  camera.width = width;
  camera.height = height;
  camera.field_of_view = fov_deg * deg;
  camera.camera_to_enu = image::look_at(azimuth * deg, elevation * deg, roll * deg);
  return camera;
}

struct ProjectionCase {
  const char* name;
  std::vector<Camera> (*cameras)(const MadeUpSky&);
};

std::vector<Camera> lat_longs(const MadeUpSky&) {
  return {camera_of(Projection::lat_long, 128, 64, 0, 25, 0),
          camera_of(Projection::lat_long, 97, 51, 0, 0, 0)};
}

std::vector<Camera> cubes(const MadeUpSky&) {
  std::vector<Camera> all{camera_of(Projection::cube, 48, 288, 0, 70, 0)};
  Camera camera = all[0];
  camera.cube_layout = image::CubeLayout::horizontal_strip;
  camera.width = 246, camera.height = 41;
  all.push_back(camera);
  camera.cube_layout = image::CubeLayout::cross;
  camera.width = 160, camera.height = 120;
  all.push_back(camera);
  camera.cube_layout = image::CubeLayout::vertical_cross;
  camera.width = 120, camera.height = 160;
  all.push_back(camera);
  return all;
}

/// Wide, rolled, and narrow ones at the sun and at the limb, where the sun is and opposite.
std::vector<Camera> perspectives(const MadeUpSky& sky) {
  const double azimuth = skylapse::azimuth(sky.sun).in(deg);
  const double elevation = skylapse::elevation(sky.sun).in(deg);
  const double horizon = 90 - sky.slice.grid.horizon_zenith_rad * 180 / kPi;
  return {camera_of(Projection::perspective, 160, 90, 75, 200, 15),
          camera_of(Projection::perspective, 90, 80, 120, 10, 60, 33),
          camera_of(Projection::perspective, 80, 80, 4, azimuth, elevation),
          camera_of(Projection::perspective, 80, 80, 4, azimuth + 180, horizon + 1, 20),
          camera_of(Projection::perspective, 80, 80, 0.2, azimuth + 30, horizon + 0.05),
          camera_of(Projection::perspective, 80, 80, 0.02, azimuth, horizon)};
}

std::vector<Camera> octahedral_maps(const MadeUpSky&) {
  return {camera_of(Projection::octahedral, 150, 150, 0, 0, 0),
          camera_of(Projection::octahedral, 113, 113, 0, 70, 0)};
}

template <Projection projection, int full_angle>
std::vector<Camera> fisheyes(const MadeUpSky&) {
  return {camera_of(projection, 150, 140, 180, 0, 90), camera_of(projection, 120, 130, 180, 30, 20),
          camera_of(projection, 110, 110, full_angle, 100, 80, 15)};
}

class SliceImage : public testing::TestWithParam<ProjectionCase> {};

// The bar of slice_image.h.
TEST_P(SliceImage, AgreesWithTheDoubleLookupOverTheWholeDomain) {
  Errors errors;
  for (const glm::dmat3& matrix : {glm::dmat3(1.0), color::xyz_to_rgb(color::RgbSpace::rec709)})
    for (const MadeUpSky& sky : made_up_skies())
      for (const Camera& camera : GetParam().cameras(sky)) {
        Errors own;
        compare(camera, sky, matrix, own);
        EXPECT_LT(own.worst, 1e-5) << sky.name << ", " << camera.field_of_view.in(deg) << " deg";
        errors.finite = errors.finite && own.finite;
        errors.worst = std::max(errors.worst, own.worst);
        errors.samples += own.samples;
      }
  std::cout << errors.samples << " samples, worst " << errors.worst << "\n";
  EXPECT_TRUE(errors.finite);
  EXPECT_GT(errors.samples, 100'000u);
}

constexpr ProjectionCase kProjections[] = {
    {"LatLong", lat_longs},
    {"Cube", cubes},
    {"Perspective", perspectives},
    {"Equidistant", fisheyes<Projection::fisheye_equidistant, 360>},
    {"Equisolid", fisheyes<Projection::fisheye_equisolid, 360>},
    {"Stereographic", fisheyes<Projection::fisheye_stereographic, 300>},
    {"MirrorBall", fisheyes<Projection::mirror_ball, 360>},
    {"Octahedral", octahedral_maps},
};

INSTANTIATE_TEST_SUITE_P(All, SliceImage, testing::ValuesIn(kProjections),
                         [](const auto& info) { return std::string(info.param.name); });

/// A sky without aerosol: then a mean over elevations is one of the smooth light alone.
MadeUpSky without_aerosol(MadeUpSky sky) {
  std::fill(sky.slice.aerosol.begin(), sky.slice.aerosol.end(), glm::vec4(0));
  return sky;
}

/// Mean over the pixel's height by brute force, sky and ground apart.
glm::dvec3 brute_mean(const Judge& judge, const View& view, double side) {
  constexpr int kSteps = 4000;
  glm::dvec3 sum(0);
  for (int i = 0; i < kSteps; ++i)
    sum += judge.at(view.over + ((i + 0.5) / kSteps - 0.5) * side, view.azimuth);
  return sum / double(kSteps);
}

// 4000 steps are right to about 1e-3 of the jump between sky and ground, one step's share.
TEST(SliceImageHorizon, PixelsAreMeansOfSkyAndGroundOverTheirHeight) {
  for (const MadeUpSky& original : made_up_skies()) {
    const MadeUpSky sky = without_aerosol(original);
    const SliceImageInputs in = inputs_of(sky);
    const double horizon = 90 - sky.slice.grid.horizon_zenith_rad * 180 / kPi;
    for (const Camera& camera : {camera_of(Projection::perspective, 9, 31, 0.4, 40, horizon, 7),
                                 camera_of(Projection::lat_long, 64, 32, 0, 0, 0)}) {
      FrameBuffer picture(camera.width, camera.height);
      render_slice(camera, in, picture);
      int means = 0;
      for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; x += 2) {
          const auto direction = image::direction_at(camera, {x + 0.5, y + 0.5});
          const View view = view_of(*direction, sky);
          const double side = side_of(camera, x, y);
          if (std::abs(view.over) > 0.999 * kMeanPixels * side) continue;
          if (side - view.over > sky.slice.grid.ground_span_rad) continue;  // over the nadir
          ++means;
          const glm::dvec3 expected = brute_mean({in}, view, side);
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(picture.pixel(x, y)[c], expected[c], 1e-3 * expected[c] + 1e-4)
                << sky.name << " " << x << " " << y;
        }
      EXPECT_GT(means, 10) << sky.name;
    }
  }
}

// A limb of a tenth of a degree in rows of a degree: its light is neither lost nor magnified,
// wherever the rows lie. A row spreads its light over its whole solid angle, which changes within
// it so near to the nadir: that is allowed for.
TEST(SliceImageHorizon, ThinLimbKeepsItsLightAtAnySize) {
  MadeUpSky sky = without_aerosol(made_up_sky(36000, 100, 140, 0.76));
  std::fill(sky.slice.smooth.begin() + long(sky.slice.smooth.size() / 2), sky.slice.smooth.end(),
            glm::vec4(0));
  const auto light = [&](int height) {
    const Camera camera = camera_of(Projection::lat_long, 8, height, 0, 0, 0);
    FrameBuffer picture(8, height);
    render_slice(camera, inputs_of(sky), picture);
    double sum = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < 8; ++x)
        sum += picture.pixel(x, y)[1] * image::pixel_solid_angle(camera, x, y).in(sr);
    return sum;
  };
  const double fine = light(20000);
  const double from_nadir = kPi - sky.slice.grid.horizon_zenith_rad;
  for (const int height : {180, 181, 183, 360, 501, 1000, 1001, 2000})
    EXPECT_NEAR(light(height) / fine, 1, 0.005 + 0.5 * kPi / height / from_nadir) << height;
}

TEST(SliceImageLaws, TheMappingIsThatOfTheSlicesOwnLookup) {
  for (const MadeUpSky& sky : made_up_skies())
    for (double azimuth = 0; azimuth <= kPi; azimuth += 0.31)
      for (double u = -1; u <= 1; u += 0.0137) {
        const SliceGrid& grid = sky.slice.grid;
        const double over = u * std::abs(u) * (u < 0 ? grid.ground_span_rad : grid.sky_span_rad);
        const glm::dvec3 own = looked_up(sky.slice, over, azimuth);
        const glm::dvec3 expected =
            sky.slice.radiance_xyz((grid.horizon_zenith_rad - over) * rad, azimuth * rad);
        ASSERT_NEAR(own.y, expected.y, 1e-7 * expected.y) << sky.name << " " << u;
      }
}

TEST(SliceIrradiance, IsTheIntegralOverTheUpperHalfOfTheSky) {
  for (const MadeUpSky& sky : made_up_skies()) {
    if (std::abs(sky.slice.aerosol_g) > 0.9) continue;  // needs a finer grid here than below
    const SliceGrid& grid = sky.slice.grid;
    glm::dvec3 sum(0);
    constexpr int kZeniths = 600, kAzimuths = 600;
    for (int i = 0; i < kZeniths; ++i)
      for (int j = 0; j < kAzimuths; ++j) {
        const double zenith = (i + 0.5) / kZeniths * kPi / 2, azimuth = (j + 0.5) / kAzimuths * kPi;
        sum += std::sin(zenith) * std::cos(zenith) *
               looked_up(sky.slice, grid.horizon_zenith_rad - zenith, azimuth);
      }
    sum *= 2 * kPi / kAzimuths * kPi / 2 / kZeniths;
    const glm::dvec3 irradiance = horizontal_irradiance_xyz(sky.slice);
    EXPECT_NEAR(irradiance.y, sum.y, 2e-3 * sum.y + 1e-12) << sky.name;
  }
}

Camera wide_camera() { return camera_of(Projection::perspective, 301, 173, 100, 250, 5, 12); }

TEST(SliceImageLaws, RowsOfAPieceEqualThoseOfTheWholeImage) {
  const MadeUpSky sky = made_up_sky(11, 95, 181, 0.7);
  for (const Camera& camera : {wide_camera(), camera_of(Projection::lat_long, 128, 64, 0, 25, 0),
                               camera_of(Projection::fisheye_equisolid, 100, 90, 180, 0, 90)}) {
    FrameBuffer whole(camera.width, camera.height), piece(camera.width, 20);
    render_slice(camera, inputs_of(sky), whole);
    render_slice_rows(camera, inputs_of(sky), 31, piece);
    EXPECT_TRUE(std::equal(piece.data().begin(), piece.data().end(), whole.row(31)));
  }
}

TEST(SliceImageLaws, ResultDoesNotDependOnTheNumberOfThreads) {
  const MadeUpSky sky = made_up_sky(0, 60, 181, 0.7);
  const Camera cube = camera_of(Projection::cube, 256, 1536, 0, 0, 0);
  FrameBuffer one(cube.width, cube.height), many(cube.width, cube.height);
  {
    const ThreadLimit limit(1);
    render_slice(cube, inputs_of(sky), one);
  }
  render_slice(cube, inputs_of(sky), many);
  EXPECT_EQ(one.data(), many.data());
}

TEST(SliceImageLaws, PictureOfASunInTheZenithHasNoAzimuth) {
  // Such a sky is round: every column of the slice is the same.
  MadeUpSky sky = made_up_sky(0, 0, 0, 0.8);
  for (int row = 0; row < sky.slice.grid.zeniths; ++row)
    for (int column = 1; column < sky.slice.grid.azimuths; ++column) {
      const size_t first = size_t(row) * sky.slice.grid.azimuths;
      sky.slice.smooth[first + column] = sky.slice.smooth[first];
      sky.slice.aerosol[first + column] = sky.slice.aerosol[first];
    }
  FrameBuffer reference(301, 173), turned(301, 173);
  render_slice(wide_camera(), inputs_of(sky), reference);
  for (const double azimuth : {90.0, 211.0}) {
    sky.sun = enu_direction(azimuth * deg, 89.9999999 * deg);
    render_slice(wide_camera(), inputs_of(sky), turned);
    for (size_t i = 0; i < turned.data().size(); ++i)
      ASSERT_NEAR(turned.data()[i], reference.data()[i], 2e-6 * reference.data()[i]);
  }
}

TEST(SliceImageLaws, SkyIsTheSameOnBothSidesOfTheSun) {
  const MadeUpSky sky = made_up_sky(2, 80, 120, 0.8);
  const Camera camera = camera_of(Projection::perspective, 200, 120, 90, 120, 10);
  FrameBuffer picture(200, 120);
  render_slice(camera, inputs_of(sky), picture);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 100; ++x)
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(picture.pixel(x, y)[c], picture.pixel(199 - x, y)[c],
                    1e-5 * picture.pixel(x, y)[c] + 1e-9);
}

TEST(SliceImageLaws, ScaleActsOnEverything) {
  const MadeUpSky sky = made_up_sky(2, 80, 120, 0.8);
  SliceImageInputs in = inputs_of(sky);
  FrameBuffer plain(301, 173), dim(301, 173);
  render_slice(wide_camera(), in, plain);
  in.scale = 1e-3;
  render_slice(wide_camera(), in, dim);
  for (size_t i = 0; i < dim.data().size(); ++i)
    ASSERT_NEAR(dim.data()[i], 1e-3 * plain.data()[i], 1e-8 * plain.data()[i]);
}

TEST(SliceImageLaws, OutsideTheCircleTheCrossAndTheAirIsBlack) {
  const MadeUpSky on_ground = made_up_sky(0, 60, 181, 0.7), in_space = made_up_sky(400, 60, 0, 0.7);
  Camera cross = camera_of(Projection::cube, 64, 48, 0, 0, 0);
  cross.cube_layout = image::CubeLayout::cross;
  for (const Camera& camera :
       {cross, camera_of(Projection::fisheye_equidistant, 60, 40, 180, 0, 90)}) {
    FrameBuffer picture(camera.width, camera.height);
    std::fill(picture.data().begin(), picture.data().end(), 7.0f);
    render_slice(camera, inputs_of(on_ground), picture);
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x) {
        const bool seen = image::direction_at(camera, {x + 0.5, y + 0.5}).has_value();
        EXPECT_EQ(picture.pixel(x, y)[1] == 0.0f, !seen) << x << " " << y;
      }
  }
  const Camera map = camera_of(Projection::lat_long, 64, 180, 0, 0, 0);
  FrameBuffer picture(64, 180);
  render_slice(map, inputs_of(in_space), picture);
  for (int y = 0; y < 180; ++y) {
    const double over = in_space.slice.grid.horizon_zenith_rad - (y + 0.5) / 180 * kPi;
    const double side = side_of(map, 0, y);
    if (over > in_space.slice.grid.sky_span_rad + 0.5 * side)
      EXPECT_EQ(picture.pixel(3, y)[1], 0.0f) << y;
    else
      EXPECT_GT(picture.pixel(3, y)[1], 0.0f) << y;
  }
}

TEST(SliceImageLaws, ZenithOfACameraInTheAirIsNotBlack) {
  for (const double height : {0.0, 11.0, 99.999}) {
    const MadeUpSky sky = made_up_sky(height, 60, 181, 0.7);
    const Camera camera = camera_of(Projection::perspective, 33, 33, 1e-4, 0, 90);
    FrameBuffer picture(33, 33);
    render_slice(camera, inputs_of(sky), picture);
    for (const float value : picture.data()) ASSERT_GT(value, 0.01f) << height;
  }
}

TEST(SliceImageLaws, SurvivesImagesOfOnePixel) {
  const MadeUpSky sky = made_up_sky(0, 60, 181, 0.7);
  for (const Projection projection :
       {Projection::perspective, Projection::lat_long, Projection::fisheye_stereographic}) {
    FrameBuffer picture(1, 1);
    render_slice(camera_of(projection, 1, 1, 60, 0, 30), inputs_of(sky), picture);
    EXPECT_TRUE(std::isfinite(picture.data()[0]));
    EXPECT_GT(picture.data()[0], 0.0f);
  }
}

}  // namespace
}  // namespace skylapse::sky::bruneton
