// Filtered cubes, irradiance maps, harmonics and textures of frames, against the model's own light.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/constants.h"
#include "image/irradiance.h"
#include "image/lighting/cube_mips.h"
#include "image/lighting/harmonics.h"
#include "image/lighting/sources.h"
#include "output/ktx2_reader.h"
#include "pipeline/job_fixture.h"
#include "pipeline/products/cube_texture.h"
#include "pipeline/products/product.h"

using namespace skylapse;
using namespace skylapse::pipeline;
using namespace skylapse::pipeline::testing;

namespace {

using config::ProductKind;
using config::ProductOutput;
using image::FrameBuffer;

/// Prague at midsummer: the sun on the horizon, high, low.
struct Skies {
  plan::Plan plan;
  std::vector<FrameLight> lights;

  explicit Skies(const std::string& space = "rec709")
      : plan(plan_of_text(
            "location: {name: Prague, latitude: 50.0755, longitude: 14.4378, height: 235 m}\n"
            "time: {zone: Europe/Prague, date: 2026-06-21, at: ['13:00', '19:30', sunrise + 1 "
            "min]}\n"
            "camera: {projection: lat-long, size: 256x128}\n"
            "sky: {model: hosek-wilkie}\n"
            "color: {space: " +
            space + "}\noutputs: [{image: 'a.####.exr'}]\n")) {
    AtmosphereService atmospheres(plan, gpu::Backend::automatic);
    for (const plan::Frame& frame : plan.frames) {
      StageTimes times;
      auto light = light_of_frame(plan, frame, atmospheres, times);
      EXPECT_TRUE(light.ok());
      lights.push_back(*std::move(light));
    }
  }

  [[nodiscard]] std::vector<ProductFile> make(const ProductOutput& output, size_t frame,
                                              size_t files = 1) const {
    const auto io = output::open_image_io();
    EXPECT_TRUE(io.ok());
    StageTimes times;
    output::FrameMetadata meta;
    meta.space = *color::rgb_space_from_name(plan.job.color.space);
    auto made = make_product({plan, plan.frames[frame], output, lights[frame], **io, meta,
                              std::vector<std::string>(files, "x")},
                             times);
    if (!made) {
      ADD_FAILURE() << format_error(made.error());
      return {};
    }
    EXPECT_EQ(made->size(), files);
    return *std::move(made);
  }
};

const Skies& skies() {
  static const Skies all;
  return all;
}

ProductOutput product(ProductKind kind, const std::string& format, int side = 0, int levels = 0) {
  ProductOutput out;
  out.kind = kind;
  out.format = format;
  out.levels = levels;
  if (side == 0) return out;
  out.view.emplace();
  image::Camera& camera = out.view->camera;
  camera = image::strip_camera({}, side);
  return out;
}

ProductOutput irradiance_map(const std::string& format, int width) {
  ProductOutput out = product(ProductKind::irradiance, format, 4);
  out.view->camera.projection = image::Projection::lat_long;
  out.view->camera.width = width, out.view->camera.height = width / 2;
  return out;
}

double relative_error(const ProductFile& file) {
  return file.encoding.at("horizontal_lux") / file.encoding.at("true_horizontal_lux") - 1;
}

FrameBuffer strip_of(const output::KtxFile& file, uint32_t level) {
  const auto& image = file.images[level];
  FrameBuffer strip(int(image.side), 6 * int(image.side));
  // Back from the left-handed order: the last two faces change places.
  const uint32_t faces[] = {0, 1, 2, 3, 5, 4};
  for (uint32_t face = 0; face < 6; ++face)
    for (uint32_t y = 0; y < image.side; ++y)
      for (uint32_t x = 0; x < image.side; ++x)
        std::copy_n(image.texel(face, x, y), 3,
                    strip.pixel(int(x), int(faces[face] * image.side + y)));
  return strip;
}

glm::dvec3 at(const image::Camera& camera, const FrameBuffer& picture, const Direction<Enu>& d) {
  const auto p = image::position_of(camera, d);
  const float* rgb =
      picture.pixel(std::min(int(p->x), camera.width - 1), std::min(int(p->y), camera.height - 1));
  return {rgb[0], rgb[1], rgb[2]};
}

TEST(SpecularProduct, FirstLevelIsTheSkyWithItsDiscAndEveryLevelHasItsLight) {
  for (size_t frame = 0; frame < 3; ++frame) {
    auto output = product(ProductKind::specular, "ktx2", 64, 5);
    output.sample_type = output::SampleType::float32;
    const auto files = skies().make(output, frame);
    EXPECT_LT(std::abs(relative_error(files[0])), 5e-3) << frame;
    EXPECT_EQ(files[0].encoding.at("sun_spread"), 1);
    const auto file = output::read_ktx2(files[0].bytes);
    ASSERT_EQ(file.problem, "");
    ASSERT_EQ(file.levels, 5U);
    EXPECT_EQ(file.key_values.at("skylapse:roughness"), "0 0.25 0.5 0.75 1");
    EXPECT_EQ(file.key_values.at("skylapse:axes"), "+X azimuth 270 deg, +Y up, +Z azimuth 180 deg");
    const glm::dvec3 flux = image::flux_of(strip_of(file, 0));
    for (uint32_t level = 1; level < 5; ++level)
      for (int c = 0; c < 3; ++c)
        // What the first level's own pixels lose of the sky's detail at the horizon.
        EXPECT_NEAR(image::flux_of(strip_of(file, level))[c] / flux[c], 1, 1e-5) << level;
  }
}

TEST(SpecularProduct, HalfFloatsKeepAllLightOfADiscThatTheyCannotShow) {
  for (size_t frame = 0; frame < 3; ++frame) {
    const auto files = skies().make(product(ProductKind::specular, "ktx2", 128, 6), frame);
    EXPECT_LT(std::abs(relative_error(files[0])), 5e-3) << frame;
    const auto file = output::read_ktx2(files[0].bytes);
    ASSERT_EQ(file.problem, "");
    if (frame == 1) {
      // 1 / 146 of a steradian at half floats' brightest is a disc of 1.5 deg.
      EXPECT_GT(files[0].encoding.at("sun_spread"), 4);
      EXPECT_LT(files[0].encoding.at("sun_spread"), 8);
    }
  }
}

TEST(SpecularProduct, LevelsAndFacesApartAreThoseOfTheTexture) {
  auto output = product(ProductKind::specular, "exr", 16, 2);
  output.sample_type = output::SampleType::float32;
  output.view->cube_faces_apart = true;
  output.orientation = image::Orientation::three;
  const auto apart = skies().make(output, 0, 12);
  output.format = "ktx2";
  const auto whole = output::read_ktx2(skies().make(output, 0)[0].bytes);
  const auto io = output::open_image_io();
  TemporaryFolder folder;
  for (uint32_t k = 0; k < 12; ++k) {
    const auto path = folder.path() / "face.exr";
    ASSERT_TRUE(output::write_file_atomically(path, apart[k].bytes));
    const auto decoded = (*io)->decode(path.string());
    ASSERT_TRUE(decoded);
    const auto& level = whole.images[k / 6];
    ASSERT_EQ(decoded->pixels.width(), int(level.side));
    for (uint32_t y = 0; y < level.side; ++y)
      for (uint32_t x = 0; x < level.side; ++x)
        for (int c = 0; c < 3; ++c)
          ASSERT_EQ(decoded->pixels.pixel(int(x), int(y))[c], level.texel(k % 6, x, y)[c]) << k;
    EXPECT_EQ(apart[k].encoding.at("roughness"), k / 6);
  }
}

TEST(SpecularProduct, SunStandsWhereTheTexturesAxesSay) {
  for (const auto orientation :
       {image::Orientation::openexr, image::Orientation::three, image::Orientation::unity}) {
    auto output = product(ProductKind::specular, "ktx2", 32, 1);
    output.orientation = orientation;
    const auto file = output::read_ktx2(skies().make(output, 1)[0].bytes);
    ASSERT_EQ(file.problem, "");
    // Brightest texel, by the faces' definition in Vulkan (Table "Cube map face and coordinates"):
    // sc and tc go right and down from -1 to 1.
    const auto& level = file.images[0];
    const float* brightest = level.texel(0, 0, 0);
    for (size_t i = 0; i < level.rgba.size(); i += 4)
      if (level.rgba[i] > brightest[0]) brightest = &level.rgba[i];
    const auto index = size_t(brightest - level.rgba.data()) / 4;
    const size_t face = index / (32 * 32);
    const double s = (double(index % 32) + 0.5) / 16 - 1;
    const double t = (double(index / 32 % 32) + 0.5) / 16 - 1;
    const glm::dvec3 lookup[] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t},
                                 {s, -1, -t}, {s, -t, 1},  {-s, -t, -1}};
    double x_azimuth = 0, z_azimuth = 0;
    ASSERT_EQ(std::sscanf(file.key_values.at("skylapse:axes").c_str(),
                          "+X azimuth %lf deg, +Y up, +Z azimuth %lf deg", &x_azimuth, &z_azimuth),
              2);
    const glm::dvec3 v = lookup[face];
    const auto d = Direction<Enu>::from_vector(v.x * enu_direction(x_azimuth * deg, {}).vec() +
                                               v.z * enu_direction(z_azimuth * deg, {}).vec() +
                                               glm::dvec3(0, 0, v.y));
    EXPECT_LT(separation(d, skies().lights[1].disc.centre).in(deg), 3)
        << image::name_of(orientation);
  }
}

TEST(IrradianceProduct, ZenithIsTheModelsIrradianceOfLevelGround) {
  for (size_t frame = 0; frame < 3; ++frame)
    for (const bool disc : {true, false}) {
      for (const std::string format : {"exr", "hdr"}) {
        auto output = irradiance_map(format, 64);
        output.sun_disc = disc;
        if (format == "hdr") output.sample_type = output::SampleType::float32;
        EXPECT_LT(std::abs(relative_error(skies().make(output, frame)[0])), 3e-3) << frame;
      }
      auto cube = product(ProductKind::irradiance, "ktx2", 16);
      cube.sun_disc = disc;
      const auto files = skies().make(cube, frame);
      EXPECT_LT(std::abs(relative_error(files[0])), 3e-3) << frame;
      EXPECT_EQ(output::read_ktx2(files[0].bytes).problem, "");
    }
}

TEST(IrradianceProduct, SurfaceThatFacesTheSunGetsItsNormalIrradiance) {
  auto with = product(ProductKind::irradiance, "ktx2", 64), without = with;
  with.sample_type = without.sample_type = output::SampleType::float32;
  without.sun_disc = false;
  const image::Camera camera = image::strip_camera({}, 64);
  for (const size_t frame : {size_t{1}, size_t{2}}) {
    const FrameBuffer a = strip_of(output::read_ktx2(skies().make(with, frame)[0].bytes), 0);
    const FrameBuffer b = strip_of(output::read_ktx2(skies().make(without, frame)[0].bytes), 0);
    const auto& disc = skies().lights[frame].disc;
    const glm::dvec3 sun = at(camera, a, disc.centre) - at(camera, b, disc.centre);
    const glm::dvec3 normal = sky::disc_energy(disc).normal_irradiance;
    // The texel's centre is up to a degree from the disc's.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sun[c] / normal[c], 1, 1e-3) << frame;
  }
}

TEST(LightProducts, OfANightAreWrittenInFloatsWhereHalvesEnd) {
  FrameLight night = skies().lights[1];
  // As dark as the sky of a night without moon: 1e-10 of the day.
  night.sky.fill = [day = skies().lights[1].sky.fill](
                       const image::Camera& camera, const glm::dmat3& matrix, int row,
                       FrameBuffer& out) { return day(camera, 1e-10 * matrix, row, out); };
  night.sky.sky_irradiance_xyz *= 1e-10;
  night.disc_shows = false;
  const auto io = output::open_image_io();
  for (const auto& output : {product(ProductKind::specular, "ktx2", 32, 3),
                             product(ProductKind::irradiance, "ktx2", 16)}) {
    StageTimes times;
    const auto made =
        make_product({skies().plan, skies().plan.frames[1], output, night, **io, {}, {"x"}}, times);
    ASSERT_TRUE(made);
    EXPECT_EQ(output::read_ktx2(made->front().bytes).vk_format, 109U);
    EXPECT_LT(std::abs(relative_error(made->front())), 5e-3);
    EXPECT_EQ(output::read_ktx2(skies().make(output, 1)[0].bytes).vk_format, 97U);
  }
}

/// What nine terms make of the irradiance of level ground by light at the sine of elevation s.
double nine_terms(double s) { return 0.25 + s / 2 + 5.0 / 32 * (3 * s * s - 1); }

TEST(HarmonicsProduct, GiveLevelGroundWhatNineTermsCan) {
  for (const std::string space : {"rec709", "acescg"}) {
    const Skies all(space);
    for (size_t frame = 0; frame < 3; ++frame)
      for (const bool disc : {true, false}) {
        const FrameLight& light = all.lights[frame];
        auto output = product(ProductKind::harmonics, "json");
        output.sun_disc = disc;
        const auto file = all.make(output, frame)[0];
        const image::Camera camera = image::strip_camera({}, 192);
        StageTimes times;
        const auto sky = light.picture(camera, Disc::without, times);
        glm::dvec3 sum{0};
        for (int y = 0; y < camera.height; ++y)
          for (int x = 0; x < camera.width; ++x) {
            const float* p = sky->pixel(x, y);
            sum += image::pixel_solid_angle(camera, x, y)
                       .in(sr)*nine_terms(image::direction_at(camera, {x + 0.5, y + 0.5})->z()) *
                   glm::dvec3(p[0], p[1], p[2]);
          }
        double expected = horizontal_lux(light, sum);
        const double normal =
            disc ? horizontal_lux(light, sky::disc_energy(light.disc).normal_irradiance) : 0;
        expected += normal * nine_terms(sin(elevation(light.disc.centre)));
        const double truth = file.encoding.at("true_horizontal_lux");
        // Pixels of 0.7 degrees against those of 0.47; the disc's size.
        EXPECT_NEAR(file.encoding.at("horizontal_lux") / expected, 1, 2e-3)
            << space << ' ' << frame << ' ' << disc;
        // And the theory's bound: 3/32 of the light, wherever it comes from.
        const double all_light = horizontal_lux(light, image::flux_of(*sky)) + normal;
        EXPECT_LT(std::abs(file.encoding.at("horizontal_lux") - truth), 3.0 / 32 * all_light);
      }
  }
}

TEST(HarmonicsProduct, SaysWhatItIsAndTurnsWithItsAxes) {
  auto output = product(ProductKind::harmonics, "json");
  std::vector<nlohmann::json> files;
  for (const auto orientation : {image::Orientation::openexr, image::Orientation::three}) {
    output.orientation = orientation;
    const auto file = skies().make(output, 1)[0];
    files.push_back(nlohmann::json::parse(
        reinterpret_cast<const char*>(file.bytes.data()),
        reinterpret_cast<const char*>(file.bytes.data()) + file.bytes.size()));
  }
  const auto irradiance_at_sun = [&](const nlohmann::json& json, image::Orientation orientation) {
    image::Harmonics light{};
    for (size_t i = 0; i < light.size(); ++i)
      for (int c = 0; c < 3; ++c) light[i][c] = json["radiance"][i][size_t(c)];
    return image::irradiance_of(
        light, image::enu_to_world(orientation) * skies().lights[1].disc.centre.vec());
  };
  EXPECT_EQ(files[0]["basis"]["order"].size(), 9U);
  EXPECT_EQ(files[1]["axes_of_xyz"]["name"], "three");
  EXPECT_EQ(files[0]["color"]["space"], "rec709");
  const auto a = irradiance_at_sun(files[0], image::Orientation::openexr);
  const auto b = irradiance_at_sun(files[1], image::Orientation::three);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c] / b[c], 1, 1e-9);
}

TEST(LightProducts, OfTheSameRequestAreTheSameBytes) {
  for (const auto& output : {product(ProductKind::specular, "ktx2", 16, 3),
                             irradiance_map("exr", 16), product(ProductKind::harmonics, "json")})
    EXPECT_EQ(skies().make(output, 0)[0].bytes, skies().make(output, 0)[0].bytes);
}

TEST(CubeTexture, HasAllMipsAndTheirLight) {
  const image::Camera camera = image::strip_camera({}, 48);
  StageTimes times;
  const auto strip = skies().lights[1].picture(camera, Disc::with, times);
  const auto made = make_cube_texture(*strip, camera, output::SampleType::float32, {},
                                      image::Orientation::gltf, times);
  ASSERT_TRUE(made);
  const auto file = output::read_ktx2(made->bytes);
  ASSERT_EQ(file.problem, "");
  ASSERT_EQ(file.levels, 6U);  // 48 24 12 6 3 1
  const glm::dvec3 flux = image::flux_of(*strip);
  for (uint32_t level = 0; level < 6; ++level)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(image::flux_of(strip_of(file, level))[c] / flux[c], 1, 1e-6);
  const double lux = horizontal_lux(skies().lights[1], image::image_irradiance(camera, *strip));
  EXPECT_NEAR(made->encoding.at("horizontal_lux") / lux, 1, 1e-9);
}

}  // namespace
