#include "pipeline/products/specular.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image/camera/cube.h"
#include "image/irradiance.h"
#include "image/lighting/cube_mips.h"
#include "image/lighting/specular.h"
#include "output/sun_policy.h"
#include "pipeline/products/cube_texture.h"

namespace skylapse::pipeline {
namespace {

// The sky is rendered no smaller, whatever the first level's side: narrow lobes see its detail.
constexpr int kSmallestSky = 128;

struct Levels {
  std::vector<image::FrameBuffer> cubes;
  std::vector<double> roughness;
  double sun_spread = 1;  // radius of the first level's disc over the sun's
};

bool is_half(const ProductRequest& request) {
  return request.output.format != "hdr" &&
         request.output.sample_type == output::SampleType::half_float;
}

/// The lowest alpha at which the disc, with the sky behind it, fits the file's numbers.
double lowest_alpha(const ProductRequest& request, const image::FrameBuffer& sky,
                    const std::vector<image::PointLight>& disc) {
  if (!is_half(request) || disc.empty()) return 0;
  const float brightest = *std::max_element(sky.data().begin(), sky.data().end());
  const double room = 0.99 * output::kLargestHalf - brightest;
  return room > 0 ? image::alpha_for_peak(disc, room) : 1;
}

/// The same light on a disc of a radius `spread` times as large.
sky::SunDisc widened(const sky::SunDisc& disc, double spread) {
  sky::SunDisc wide = disc;
  wide.radius = std::min(10 * deg, spread * disc.radius);
  const Angle centre = elevation(disc.centre);
  const auto radiance = [disc, spread, centre](Angle view, double limb) {
    const Angle there = centre + (view - centre) / spread;
    return disc.radiance(std::max(disc.horizon, there), limb);
  };
  wide.radiance = radiance;
  const glm::dvec3 flux = sky::disc_energy(disc).normal_irradiance;
  const glm::dvec3 wider = sky::disc_energy(wide).normal_irradiance;
  glm::dvec3 factor{0};
  for (int c = 0; c < 3; ++c)
    if (wider[c] > 0) factor[c] = flux[c] / wider[c];
  wide.radiance = [radiance, factor](Angle view, double limb) {
    return factor * radiance(view, limb);
  };
  return wide;
}

/// Level 0: the sky with its disc, made wider until the file's numbers hold it.
void add_mirrored_disc(const ProductRequest& request, const image::Camera& camera, Levels& levels,
                       StageTimes& times) {
  image::FrameBuffer& cube = levels.cubes.front();
  const image::Camera view = image::strip_camera(camera, cube.width());
  if (!is_half(request)) return request.light.add_disc_rows(view, 0, cube, times);
  const image::FrameBuffer sky = cube;
  request.light.add_disc_rows(view, 0, cube, times);
  // A disc that covers the pixels of a face is wide enough for any light the sun has.
  while (output::exceeds_half(cube) && levels.sun_spread < 64) {
    const float brightest = *std::max_element(cube.data().begin(), cube.data().end());
    levels.sun_spread *= std::max(1.02, 1.01 * std::sqrt(brightest / output::kLargestHalf));
    FrameLight light = request.light;
    light.disc = widened(request.light.disc, levels.sun_spread);
    cube = sky;
    light.add_disc_rows(view, 0, cube, times);
  }
}

/// Levels from 1 on.
void add_filtered(const ProductRequest& request, const image::Camera& camera,
                  const image::FrameBuffer& sky, const std::vector<image::PointLight>& disc,
                  double least, Levels& levels, StageTimes& times) {
  const int count = request.output.levels;
  if (count <= 1) return;
  const StageTimer timer(times, Stage::product);
  const double narrowest = image::alpha_of_roughness(image::roughness_of_level(1, count));
  const image::SpecularSource source(camera, sky, narrowest);
  for (int level = 1; level < count; ++level) {
    const double roughness = image::roughness_of_level(level, count);
    const double alpha = image::alpha_of_roughness(roughness);
    image::FrameBuffer cube = source.filtered(image::level_side(camera.width, level), alpha);
    image::add_filtered_lights(camera, disc, std::max(alpha, least), cube);
    levels.roughness.push_back(roughness);
    levels.cubes.push_back(std::move(cube));
  }
}

Result<Levels> levels_of(const ProductRequest& request, const image::Camera& camera,
                         StageTimes& times) {
  const int side = camera.width, sky_side = side * ((kSmallestSky + side - 1) / side);
  auto sky = request.light.picture(image::strip_camera(camera, sky_side), Disc::without, times);
  if (!sky) return sky.error();
  const auto disc = disc_lights(request);
  const double least = lowest_alpha(request, *sky, disc);
  Levels levels;
  levels.cubes.emplace_back();  // the first, when the others no longer need the sky
  levels.roughness.push_back(0);
  add_filtered(request, camera, *sky, disc, least, levels, times);
  levels.cubes.front() = sky_side == side ? *std::move(sky) : image::shrunk_cube(*sky, side);
  if (!disc.empty()) add_mirrored_disc(request, camera, levels, times);
  return levels;
}

std::string list_of(const std::vector<double>& values) {
  return fmt::format("{:.6g}", fmt::join(values, " "));
}

/// What the file's numbers of a level give to level ground.
double stored_lux(const ProductRequest& request, const image::Camera& camera,
                  output::SampleType type, image::FrameBuffer cube) {
  round_as_stored(request.output.format, type, cube);
  return horizontal_lux(request.light,
                        image::image_irradiance(image::strip_camera(camera, cube.width()), cube));
}

}  // namespace

Result<std::vector<ProductFile>> make_specular(const ProductRequest& request, StageTimes& times) {
  const image::Camera camera = image::strip_camera(
      product_camera(request.output), image::cube_face_size(product_camera(request.output)));
  const auto levels = levels_of(request, camera, times);
  if (!levels) return levels.error();
  const double true_lux = true_horizontal_lux(request);
  const output::SampleType type = stored_type(request, levels->cubes.front());
  std::vector<ProductFile> files;
  if (request.output.format == "ktx2") {
    auto file =
        cube_texture_of(levels->cubes, camera, type, request.meta, request.output.orientation,
                        {{"skylapse:roughness", list_of(levels->roughness)},
                         {"skylapse:filter", "GGX, alpha = roughness^2, N = V = R"}},
                        times);
    if (!file) return file.error();
    file->encoding["true_horizontal_lux"] = true_lux;
    file->encoding["sun_spread"] = levels->sun_spread;
    file->encoding["stored_bits"] = stored_bits(type);
    files.push_back(*std::move(file));
    return files;
  }
  for (size_t level = 0; level < levels->cubes.size(); ++level) {
    auto made = picture_files(request, levels->cubes[level], type,
                              {{"skylapse:roughness", list_of({levels->roughness[level]})},
                               {"skylapse:filter", "GGX, alpha = roughness^2, N = V = R"}},
                              times);
    if (!made) return made.error();
    const double lux = stored_lux(request, camera, type, levels->cubes[level]);
    for (ProductFile& file : *made) {
      file.encoding = {{"horizontal_lux", lux},
                       {"true_horizontal_lux", true_lux},
                       {"stored_bits", stored_bits(type)},
                       {"roughness", levels->roughness[level]}};
      if (level == 0) file.encoding["sun_spread"] = levels->sun_spread;
      files.push_back(std::move(file));
    }
  }
  return files;
}

}  // namespace skylapse::pipeline
