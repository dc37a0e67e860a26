// The sun as a light of its own, and the dome that stands beside it.
#include "pipeline/products/sun_light.h"

#include <regex>
#include <sstream>

#include <nlohmann/json.hpp>

#include "core/constants.h"
#include "image/irradiance.h"
#include "pipeline/job_fixture.h"
#include "pipeline/products/dome.h"

using namespace skylapse;
using namespace skylapse::pipeline;
using namespace skylapse::pipeline::testing;

namespace {

using nlohmann::json;

std::string scene(const std::string& times, const std::string& outputs,
                  const std::string& more = "") {
  return "location: {name: Prague, latitude: 50.0755, longitude: 14.4378, height: 235 m}\n"
         "time: {zone: Europe/Prague, date: 2026-06-21, at: [" +
         times +
         "]}\ncamera: {projection: lat-long, size: 256x128, look_at: {azimuth: 30 deg}}\n"
         "sky: {model: hosek-wilkie}\n" +
         more + "outputs: [" + outputs + "]\n";
}

/// A plan with the light of its frames.
struct Lit {
  plan::Plan plan;
  std::vector<FrameLight> lights;

  explicit Lit(const std::string& text) : plan(plan_of_text(text)) {
    AtmosphereService atmospheres(plan, gpu::Backend::automatic);
    for (const plan::Frame& frame : plan.frames) {
      StageTimes times;
      auto light = light_of_frame(plan, frame, atmospheres, times);
      EXPECT_TRUE(light.ok());
      lights.push_back(*std::move(light));
    }
  }

  Result<std::vector<ProductFile>> make(const config::ProductOutput& output, size_t frame = 0,
                                        const std::string& file = "sky/sun.usda") const {
    const auto io = output::open_image_io();
    EXPECT_TRUE(io.ok());
    StageTimes times;
    return make_product({plan, plan.frames[frame], output, lights[frame], **io, {}, {file}}, times);
  }
};

config::ProductOutput product(config::ProductKind kind, const std::string& format,
                              image::Orientation orientation) {
  config::ProductOutput output;
  output.kind = kind;
  output.format = format;
  output.orientation = orientation;
  return output;
}

std::string text_of(const ProductFile& file) {
  return {reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()};
}

/// The numbers of the first line of a layer that holds `name`, after it; of the prim `prim`.
std::vector<double> numbers_of(const std::string& text, const std::string& prim,
                               const std::string& name) {
  const size_t from = text.find(name, text.find(prim));
  EXPECT_NE(from, std::string::npos) << name;
  const std::string line =
      text.substr(from + name.size(), text.find('\n', from) - from - name.size());
  std::vector<double> all;
  static const std::regex number("-?[0-9.]+(e-?[0-9]+)?");
  for (std::sregex_iterator i(line.begin(), line.end(), number), end; i != end; ++i)
    all.push_back(std::stod(i->str()));
  return all;
}

/// Where a prim's local axis points, by its matrix for row vectors.
glm::dvec3 axis_of(const std::string& text, const std::string& prim, int axis) {
  const auto m = numbers_of(text, prim, "matrix4d xformOp:transform = ");
  EXPECT_EQ(m.size(), 16U);
  return {m[4 * axis], m[4 * axis + 1], m[4 * axis + 2]};
}

const std::vector<image::Orientation> kStages{
    image::Orientation::openexr, image::Orientation::usd,  image::Orientation::blender,
    image::Orientation::three,   image::Orientation::gltf, image::Orientation::pbrt,
    image::Orientation::mitsuba};

TEST(SunLight, PointsAtTheSunInTheAxesOfEveryOrientation) {
  const Lit lit(scene("'09:00'", "{image: a.####.exr}"));
  const glm::dvec3 sun = lit.plan.frames[0].sky.sun_apparent.vec();
  for (const auto orientation : image::kOrientations) {
    const auto made = lit.make(product(config::ProductKind::sun, "json", orientation));
    ASSERT_TRUE(made.ok());
    const json j = json::parse(text_of(made->front()));
    const glm::dvec3 expected = image::enu_to_world(orientation) * sun;
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(j["light_comes_from"]["axes"][i].get<double>(), expected[i], 1e-12);
      EXPECT_NEAR(j["light_comes_from"]["east_north_up"][i].get<double>(), sun[i], 1e-12);
    }
    EXPECT_EQ(j["orientation"]["name"], image::name_of(orientation));
  }
  for (const auto orientation : kStages) {
    const auto made = lit.make(product(config::ProductKind::sun, "usda", orientation));
    ASSERT_TRUE(made.ok());
    const glm::dvec3 to_sun = axis_of(text_of(made->front()), "\"Sun\"", 2);
    EXPECT_LT(glm::distance(to_sun, image::enu_to_world(orientation) * sun), 1e-12);
    // Right-handed, so that nothing is turned inside out.
    const glm::dvec3 x = axis_of(text_of(made->front()), "\"Sun\"", 0),
                     y = axis_of(text_of(made->front()), "\"Sun\"", 1);
    EXPECT_LT(glm::distance(glm::cross(x, y), to_sun), 1e-12);
  }
}

// From a mountain or an orbit the sun is seen below elevation 0 too, where level ground has none of
// it.
TEST(SunLight, OfALowSunSeenFromAHeightGivesLevelGroundTheIrradianceOfItsDisc) {
  for (const char* height : {"3000 m", "400 km"}) {
    const Lit lit(std::string("location: {name: High, latitude: 46, longitude: 8, height: ") +
                  height +
                  "}\ntime: {zone: UTC, date: 2026-03-20, sun_elevations: [1 deg, 0.1 deg, 0 deg, "
                  "-0.5 deg], half: morning}\n"
                  "camera: {projection: lat-long, size: 16x8}\n"
                  "sky: {model: bruneton, level: draft, wavelengths: 3}\n"
                  "outputs: [{image: a.####.exr}]\n");
    ASSERT_EQ(lit.plan.frames.size(), 4U);
    for (size_t f = 0; f < lit.plan.frames.size(); ++f) {
      const auto made =
          lit.make(product(config::ProductKind::sun, "json", image::Orientation::usd), f);
      ASSERT_TRUE(made.ok());
      const double truth = made->front().encoding.at("true_horizontal_lux");
      EXPECT_NEAR(made->front().encoding.at("horizontal_lux"), truth, 1e-9 * truth)
          << height << ", frame " << f;
    }
  }
}

TEST(SunLight, OfALeftHandedProgramHasNoUsdStage) {
  const Lit lit(scene("'09:00'", "{image: a.####.exr}"));
  for (const auto orientation : {image::Orientation::unity, image::Orientation::unreal}) {
    const auto made = lit.make(product(config::ProductKind::sun, "usda", orientation));
    ASSERT_FALSE(made.ok());
    EXPECT_EQ(made.error().code, ErrorCode::invalid_input);
  }
}

// Sinking through the horizon: 21:10 is before sunset, in the following minutes the disc is cut.
TEST(SunLight, GivesLevelGroundTheIrradianceOfTheDiscWhereverItStands) {
  const Lit lit(
      scene("solar_noon, '18:00', sunset - 3 min, sunset - 2 min, sunset - 1 min, "
            "sunset - 10 s, sunset + 20 min",
            "{image: a.####.exr}"));
  bool cut = false, below = false;
  for (size_t f = 0; f < lit.plan.frames.size(); ++f) {
    const auto made =
        lit.make(product(config::ProductKind::sun, "json", image::Orientation::usd), f);
    ASSERT_TRUE(made.ok());
    const json j = json::parse(text_of(made->front()));
    const double truth = kLuminousEfficacy * lit.lights[f].disc_energy.horizontal_irradiance.y;
    EXPECT_NEAR(j["horizontal_irradiance"]["lux"].get<double>(), truth, 1e-9 * truth);
    EXPECT_EQ(made->front().encoding.at("true_horizontal_lux"), truth);
    // A direction instead of a disc: the sine is averaged over half a degree. A low sun's direction
    // and colour are chosen to be exact.
    const bool low = elevation(lit.lights[f].disc.centre) < 5 * deg;
    const double bound = low ? 1e-9 : 1e-4;
    EXPECT_NEAR(made->front().encoding.at("horizontal_lux"), truth, bound * truth) << "frame " << f;
    cut = cut || j["state"] == "on the horizon";
    if (j["state"] == "below the horizon") {
      below = true;
      EXPECT_EQ(truth, 0);
      EXPECT_EQ(j["normal_irradiance"]["lux"], 0);
      EXPECT_EQ(j["disc"]["mean_luminance_cd_m2"], 0);
      EXPECT_TRUE(j["light_color"].is_null());
      EXPECT_LT(j["light_comes_from"]["elevation_deg"].get<double>(), 0);
    } else {
      EXPECT_GT(j["light_comes_from"]["elevation_deg"].get<double>(), 0);
    }
  }
  EXPECT_TRUE(cut);
  EXPECT_TRUE(below);
}

// By UsdLux a normalised distant light of intensity 1 gives a surface that faces it irradiance 1.
TEST(SunLight, HasTheFluxThatPicturesHaveMoreWithTheDisc) {
  for (const char* space : {"rec709", "acescg"}) {
    const Lit lit(
        scene("'09:00'", "{image: a.####.exr}", std::string("color: {space: ") + space + "}\n"));
    const image::Camera& camera = lit.plan.job.cameras[0].camera;
    StageTimes times;
    const auto with = lit.lights[0].picture(camera, Disc::with, times);
    const auto without = lit.lights[0].picture(camera, Disc::without, times);
    const glm::dvec3 disc =
        image::image_flux(camera, *with).total - image::image_flux(camera, *without).total;
    const auto made = lit.make(product(config::ProductKind::sun, "usda", image::Orientation::usd));
    ASSERT_TRUE(made.ok());
    const std::string text = text_of(made->front());
    const double intensity = numbers_of(text, "\"Sun\"", "inputs:intensity = ")[0];
    const auto color = numbers_of(text, "\"Sun\"", "inputs:color = ");
    EXPECT_NE(text.find("bool inputs:normalize = 1"), std::string::npos);
    // Pixels are floats, and the difference of two sums of them.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(intensity * color[c] / disc[c], 1, 1e-4) << space;
    EXPECT_NEAR(numbers_of(text, "\"Sun\"", "inputs:angle = ")[0],
                2 * lit.plan.frames[0].sky.sun_radius.in(deg), 1e-6);
  }
}

TEST(Dome, ShowsEveryDirectionOfItsMapWhereItIsInTheStage) {
  const Lit lit(scene("'09:00'", "{image: 'maps/a.####.exr'}"));
  const image::Camera& camera = lit.plan.job.cameras[0].camera;
  for (const auto orientation : kStages) {
    auto output = product(config::ProductKind::dome, "usda", orientation);
    output.map_path.value = "maps/a.####.exr";
    const auto made = lit.make(output, 0, "maps/usd/dome.usda");
    ASSERT_TRUE(made.ok()) << made.error().message;
    const std::string text = text_of(made->front());
    EXPECT_NE(text.find("@../a.0001.exr@"), std::string::npos) << text;
    EXPECT_EQ(text.find("DistantLight"), std::string::npos) << "the map holds the disc";
    const bool z_up = image::convention_of(orientation).up.z > 0.5;
    EXPECT_NE(text.find(z_up ? "upAxis = \"Z\"" : "upAxis = \"Y\""), std::string::npos);
    const glm::dmat3 axes{axis_of(text, "\"Dome\"", 0), axis_of(text, "\"Dome\"", 1),
                          axis_of(text, "\"Dome\"", 2)};
    for (double azimuth = 5; azimuth < 360; azimuth += 40)
      for (double elevation = -70; elevation < 90; elevation += 35) {
        const auto d = enu_direction(azimuth * deg, elevation * deg);
        const glm::dvec3 local =
            glm::transpose(axes) * (image::enu_to_world(orientation) * d.vec());
        // OpenEXR: longitude atan2(x, z) from +pi at the left edge, latitude from the top.
        const double u = 0.5 - std::atan2(local.x, local.z) / (2 * std::numbers::pi);
        const double v = std::acos(local.y) / std::numbers::pi;
        const auto seen = image::direction_at(camera, {u * camera.width, v * camera.height});
        EXPECT_LT(separation(*seen, d).in(deg), 1e-6);
      }
  }
}

TEST(Dome, HasTheSunBesideItWhereItsMapDoesNot) {
  const Lit lit(
      scene("'09:00'",
            "{image: split.####.exr, type: half, sun: split}, {image: scale.####.exr, type: half, "
            "sun: scale}"));
  auto output = product(config::ProductKind::dome, "usda", image::Orientation::usd);
  output.map_path.value = "split.####.exr";
  const auto split = lit.make(output, 0, "dome.usda");
  ASSERT_TRUE(split.ok());
  EXPECT_NE(text_of(split->front()).find("@./split.0001.exr@"), std::string::npos);
  EXPECT_NE(text_of(split->front()).find("DistantLight \"Sun\""), std::string::npos);
  EXPECT_EQ(numbers_of(text_of(split->front()), "\"Dome\"", "inputs:intensity = ")[0], 1);

  output.map_path.value = "scale.####.exr";
  const auto scaled = lit.make(output, 0, "dome.usda");
  ASSERT_TRUE(scaled.ok());
  EXPECT_EQ(text_of(scaled->front()).find("DistantLight"), std::string::npos);
  const double intensity =
      numbers_of(text_of(scaled->front()), "\"Dome\"", "inputs:intensity = ")[0];
  StageTimes times;
  auto picture = lit.lights[0].picture(lit.plan.job.cameras[0].camera, Disc::with, times);
  const auto record = output::apply_sun_policy(*picture, output::SunPolicy::scale);
  EXPECT_LT(record->scale, 1);
  EXPECT_EQ(intensity, 1 / record->scale);
}

TEST(Dome, IsRefusedForMapsThatItCannotShow) {
  const Lit lit(scene("'09:00'", "{image: a.####.exr}, {image: b.####.png}"));
  auto output = product(config::ProductKind::dome, "usda", image::Orientation::usd);
  for (const char* map : {"b.####.png", "c.####.exr"}) {
    output.map_path = {map, {"scene.yaml", 7, 3}};
    const auto made = lit.make(output);
    ASSERT_FALSE(made.ok()) << map;
    EXPECT_EQ(made.error().code, ErrorCode::invalid_input);
    EXPECT_EQ(made.error().span.line, 7);
    EXPECT_FALSE(made.error().hint.empty());
  }
}

}  // namespace
