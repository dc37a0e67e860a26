#include "pipeline/products/harmonics.h"

#include <nlohmann/json.hpp>

#include "color/rgb_space.h"
#include "core/constants.h"
#include "core/version.h"
#include "image/lighting/cube_mips.h"
#include "image/lighting/harmonics.h"
#include "image/orientation.h"
#include "pipeline/products/cube_texture.h"
#include "pipeline/products/usda.h"
#include "plan/sky_model.h"

namespace skylapse::pipeline {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSkySide = 128;

Json list(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

Json list(const image::Harmonics& h) {
  Json all = Json::array();
  for (const glm::dvec3& v : h) all.push_back(list(v));
  return all;
}

Json basis_json() {
  return {{"order", {"0,0", "1,-1", "1,0", "1,1", "2,-2", "2,-1", "2,0", "2,1", "2,2"}},
          {"functions",
           {"sqrt(1/(4 pi))", "sqrt(3/(4 pi)) y", "sqrt(3/(4 pi)) z", "sqrt(3/(4 pi)) x",
            "sqrt(15/(4 pi)) x y", "sqrt(15/(4 pi)) y z", "sqrt(5/(16 pi)) (3 z^2 - 1)",
            "sqrt(15/(4 pi)) x z", "sqrt(15/(16 pi)) (x^2 - y^2)"}},
          {"normalisation", "real, orthonormal over the sphere, without the Condon-Shortley sign"},
          {"cosine_factors",
           {image::kCosineFactors[0], image::kCosineFactors[1], image::kCosineFactors[2]}},
          {"source",
           "Ramamoorthi & Hanrahan 2001, An Efficient Representation for Irradiance "
           "Environment Maps, Eqs. 3 and 8"}};
}

Json axes_json(image::Orientation orientation) {
  const auto& convention = image::convention_of(orientation);
  return {{"name", convention.name},
          {"east", list(convention.east)},
          {"north", list(convention.north)},
          {"up", list(convention.up)}};
}

}  // namespace

Result<std::vector<ProductFile>> make_harmonics(const ProductRequest& request, StageTimes& times) {
  const image::Camera camera = image::strip_camera({}, kSkySide);
  const auto picture = request.light.picture(camera, Disc::without, times);
  if (!picture) return picture.error();
  const StageTimer timer(times, Stage::product);
  const glm::dmat3 axes = image::enu_to_world(request.output.orientation);
  const image::Harmonics sky = image::project_picture(camera, *picture, axes);
  const image::Harmonics disc = image::project_lights(disc_lights(request), axes);
  const image::Harmonics light = image::sum_of(sky, disc);
  const plan::Frame& frame = request.frame;
  const Json json{
      {"program", "skylapse"},
      {"version", kVersion},
      {"site", request.plan.job.sites[frame.site].name},
      {"utc", format_utc(frame.instant, 3)},
      {"local", format_local(frame.local)},
      {"model", plan::name_of(request.plan.model)},
      {"axes_of_xyz", axes_json(request.output.orientation)},
      {"basis", basis_json()},
      {"color",
       {{"space", request.plan.job.color.space}, {"white_luminance_cd_m2", kLuminousEfficacy}}},
      {"units",
       {{"radiance", "coefficients L_lm of the light from a direction; 1.0 is 683 cd/m^2"},
        {"irradiance",
         "coefficients of the irradiance of a surface by its normal, L_lm times the degree's "
         "cosine factor; 1.0 is 683 lux; albedo / pi times it is sent out"}}},
      {"radiance", list(light)},
      {"radiance_of_sky", list(sky)},
      {"radiance_of_disc", list(disc)},
      {"irradiance", list(image::cosine_convolved(light))}};
  ProductFile file = text_product(json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
  const glm::dvec3 up = axes * glm::dvec3(0, 0, 1);
  file.encoding = {
      {"horizontal_lux", horizontal_lux(request.light, image::irradiance_of(light, up))},
      {"true_horizontal_lux", true_horizontal_lux(request)},
      {"terms", 9}};
  return std::vector<ProductFile>{std::move(file)};
}

}  // namespace skylapse::pipeline
