#include "pipeline/products/sun_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "color/rgb_space.h"
#include "core/constants.h"
#include "core/version.h"
#include "pipeline/products/usda.h"
#include "plan/sky_model.h"

namespace skylapse::pipeline {
namespace {

using Json = nlohmann::ordered_json;

Json list(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

Angle half_height(const sky::SunDisc& disc) { return disc.radius * disc.flattening; }

SunState state_of(const sky::SunDisc& disc) {
  const Angle centre = elevation(disc.centre);
  if (centre + half_height(disc) <= disc.horizon) return SunState::below;
  return centre - half_height(disc) >= disc.horizon ? SunState::above : SunState::on_horizon;
}

/// Below this the air dims the lower limb so much more than the upper one that the light comes from
/// above the disc's centre: at 0 deg by 0.04 deg, at 5 deg by 0.005 deg, in air of turbidity 5.
constexpr Angle kLowSun = 5 * deg;

Direction<Enu> centre_of_light(const sky::SunDisc& disc, const sky::DiscEnergy& energy) {
  const Angle centre = elevation(disc.centre);
  const double normal = energy.normal_irradiance.y, level = energy.horizontal_irradiance.y;
  if (centre < kLowSun && level > 0 && normal > 0)
    return enu_direction(azimuth(disc.centre), std::asin(std::min(level / normal, 1.0)) * rad);
  if (state_of(disc) != SunState::on_horizon) return disc.centre;
  const Angle upper = centre + half_height(disc);
  return enu_direction(azimuth(disc.centre), (disc.horizon + upper) / 2);
}

/// A red sun lies outside small gamuts: cutting a negative channel off adds luminance, which is
/// taken back from the others.
glm::dvec3 of_luminance(double y, const glm::dvec3& rgb, const glm::dmat3& rgb_to_xyz) {
  const double has = (rgb_to_xyz * rgb).y;
  return has > 0 ? rgb * (y / has) : rgb;
}

std::string_view word_of(SunState state) {
  switch (state) {
    case SunState::above:
      return "above the horizon";
    case SunState::on_horizon:
      return "on the horizon";
    case SunState::below:
      break;
  }
  return "below the horizon";
}

Json direction_json(const ProductRequest& request, const Direction<Enu>& d) {
  return {{"azimuth_deg", azimuth(d).in(deg)},
          {"elevation_deg", elevation(d).in(deg)},
          {"east_north_up", list(d.vec())},
          {"axes", list(image::enu_to_world(request.output.orientation) * d.vec())}};
}

Json irradiance_json(const glm::dvec3& rgb, const glm::dvec3& xyz) {
  return {{"rgb", list(rgb)}, {"xyz", list(xyz)}, {"lux", kLuminousEfficacy * xyz.y}};
}

/// Nothing to say of no light.
Json color_json(const SunLight& sun) {
  const double brightest = std::max({sun.normal_rgb.x, sun.normal_rgb.y, sun.normal_rgb.z});
  if (brightest <= 0) return nullptr;
  const auto xy = color::chromaticity({sun.normal_xyz});
  const double kelvin = color::correlated_colour_temperature_k(xy);
  // The formula's own range; a redder sun has a chromaticity, but no temperature worth telling.
  const bool sensible = kelvin >= 3000 && kelvin <= 800000;
  return {{"rgb", list(sun.normal_rgb / brightest)},
          {"xy", {xy.x, xy.y}},
          {"correlated_temperature_k", sensible ? Json(kelvin) : Json(nullptr)}};
}

Json sun_json(const ProductRequest& request, const SunLight& sun) {
  const plan::Frame& frame = request.frame;
  const auto& convention = image::convention_of(request.output.orientation);
  const sky::SunDisc& disc = request.light.disc;
  const double sin_radius = sin(disc.radius);
  const double area = std::numbers::pi * sin_radius * sin_radius * disc.flattening;
  Json color{{"space", request.plan.job.color.space}, {"white_luminance_cd_m2", kLuminousEfficacy}};
  if (const auto space = color::rgb_space_from_name(request.plan.job.color.space))
    color["chromaticities"] = color::exr_chromaticities(*space);
  Json units{{"rgb", "scene-linear; irradiance as of the maps: 1.0 is 683 lux"},
             {"xyz", "W m^-2 weighted with CIE 1931, no normalisation: 683 Y is lux"}};
  const glm::dvec3 mean_radiance =
      sun.state == SunState::below ? glm::dvec3(0) : sun.normal_xyz / area;
  return {{"program", "skylapse"},
          {"version", kVersion},
          {"site", request.plan.job.sites[frame.site].name},
          {"utc", format_utc(frame.instant, 3)},
          {"local", format_local(frame.local)},
          {"model", plan::name_of(request.plan.model)},
          {"state", word_of(sun.state)},
          {"orientation",
           {{"name", convention.name},
            {"east", list(convention.east)},
            {"north", list(convention.north)},
            {"up", list(convention.up)}}},
          {"light_comes_from", direction_json(request, sun.from)},
          {"disc",
           {{"apparent_centre", direction_json(request, frame.sky.sun_apparent)},
            {"true_centre", direction_json(request, frame.sky.sun_true)},
            {"angular_diameter_deg", 2 * disc.radius.in(deg)},
            {"flattening", disc.flattening},
            {"horizon_deg", disc.horizon.in(deg)},
            // Of a cut disc: over its whole area.
            {"mean_luminance_cd_m2", kLuminousEfficacy * mean_radiance.y}}},
          {"normal_irradiance", irradiance_json(sun.normal_rgb, sun.normal_xyz)},
          {"horizontal_irradiance", irradiance_json(sun.horizontal_rgb, sun.horizontal_xyz)},
          {"light_color", color_json(sun)},
          {"color", color},
          {"units", units}};
}

/// What the light, as the file has it, gives to level ground.
double level_lux(const ProductRequest& request, const SunLight& sun) {
  const auto space = color::rgb_space_from_name(request.plan.job.color.space);
  if (!space) return 0;
  const double y = (color::rgb_to_xyz(*space) * sun.normal_rgb).y;
  return kLuminousEfficacy * y * std::max(0.0, sin(elevation(sun.from)));
}

}  // namespace

SunLight sun_light_of(const FrameLight& light) {
  SunLight sun;
  sun.state = state_of(light.disc);
  sun.from = light.disc.centre;
  if (sun.state == SunState::below) return sun;
  const sky::DiscEnergy rgb = sky::disc_energy(light.disc);
  const glm::dmat3 rgb_to_xyz = glm::inverse(light.xyz_to_rgb);
  sun.normal_xyz = light.disc_energy.normal_irradiance;
  sun.horizontal_xyz = light.disc_energy.horizontal_irradiance;
  sun.normal_rgb = of_luminance(sun.normal_xyz.y, rgb.normal_irradiance, rgb_to_xyz);
  sun.horizontal_rgb = of_luminance(sun.horizontal_xyz.y, rgb.horizontal_irradiance, rgb_to_xyz);
  sun.from = centre_of_light(light.disc, light.disc_energy);
  return sun;
}

std::string distant_light_usda(const ProductRequest& request, const SunLight& sun,
                               const std::string& indent) {
  const glm::dmat3 to_world = image::enu_to_world(request.output.orientation);
  // Local +Z points at the sun, local X lies level (at the zenith: east).
  const glm::dvec3 z = to_world * sun.from.vec();
  const glm::dvec3 x = to_world * enu_direction(azimuth(sun.from) - 90 * deg, {}).vec();
  const double intensity = std::max({sun.normal_rgb.x, sun.normal_rgb.y, sun.normal_rgb.z});
  const glm::dvec3 color = intensity > 0 ? sun.normal_rgb / intensity : glm::dvec3(1);
  const std::string inner = indent + "    ";
  return fmt::format(
      "{0}def DistantLight \"Sun\" (\n{0}    doc = \"{1}\"\n{0})\n{0}{{\n"
      "{0}    float inputs:angle = {2:.9g}\n"
      "{0}    color3f inputs:color = ({3:.9g}, {4:.9g}, {5:.9g})\n"
      "{0}    float inputs:exposure = 0\n"
      "{0}    float inputs:intensity = {6:.9g}\n"
      "{0}    bool inputs:normalize = 1\n"
      "{7}{0}}}\n",
      indent, word_of(sun.state), 2 * request.light.disc.radius.in(deg), color.x, color.y, color.z,
      intensity, usda_transform({x, glm::cross(z, x), z}, inner));
}

Result<std::vector<ProductFile>> make_sun(const ProductRequest& request) {
  const SunLight sun = sun_light_of(request.light);
  ProductFile file;
  if (request.output.format == "usda") {
    auto head = usda_head(request);
    if (!head) return head.error();
    file = text_product(*head + "def Xform \"Sky\"\n{\n" +
                        distant_light_usda(request, sun, "    ") + "}\n");
  } else {
    file = text_product(sun_json(request, sun).dump(1, ' ', false, Json::error_handler_t::replace) +
                        "\n");
  }
  file.encoding = {{"horizontal_lux", level_lux(request, sun)},
                   {"true_horizontal_lux", kLuminousEfficacy * sun.horizontal_xyz.y}};
  return std::vector<ProductFile>{std::move(file)};
}

}  // namespace skylapse::pipeline
