#include "pipeline/products/irradiance.h"

#include <algorithm>
#include <vector>

#include "image/irradiance.h"
#include "image/lighting/cube_mips.h"
#include "image/lighting/irradiance_map.h"
#include "pipeline/products/cube_texture.h"

namespace skylapse::pipeline {
namespace {

constexpr int kSkySide = 128;

/// The pixels that a reader mixes for a surface that looks straight up: of a cube those about the
/// middle of the upper face, of a lat-long map the first row.
std::vector<float*> zenith_pixels(const image::Camera& camera, image::FrameBuffer& map) {
  std::vector<float*> pixels;
  if (camera.projection == image::Projection::lat_long) {
    for (int x = 0; x < camera.width; ++x) pixels.push_back(map.pixel(x, 0));
    return pixels;
  }
  const int side = camera.width, first = (side - 1) / 2, last = side / 2;
  for (const int y : {first, last})
    for (const int x : {first, last}) pixels.push_back(map.pixel(x, 2 * side + y));
  return pixels;
}

glm::dvec3 mean_of(const std::vector<float*>& pixels) {
  glm::dvec3 sum{0};
  for (const float* p : pixels) sum += glm::dvec3(p[0], p[1], p[2]);
  return sum / double(pixels.size());
}

/// Sets the mean about the zenith to the irradiance of level ground. No map holds a sun on the
/// horizon right: the irradiance has a bend there, on one side of which it is nothing.
void set_level_ground(const image::Camera& camera, const glm::dvec3& level,
                      image::FrameBuffer& map) {
  auto pixels = zenith_pixels(camera, map);
  std::sort(pixels.begin(), pixels.end());  // of an odd side one pixel counts four times
  pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
  const glm::dvec3 mean = mean_of(pixels);
  for (float* p : pixels)
    for (int c = 0; c < 3; ++c)
      if (mean[c] > 0) p[c] = float(p[c] * (level[c] / mean[c]));
}

glm::dvec3 level_ground(const image::Camera& sky_camera, const image::FrameBuffer& sky,
                        const std::vector<image::PointLight>& disc) {
  glm::dvec3 level = image::image_irradiance(sky_camera, sky);
  for (const image::PointLight& light : disc)
    level += std::max(0.0, light.direction.z()) * light.irradiance;
  return level;
}

}  // namespace

Result<std::vector<ProductFile>> make_irradiance(const ProductRequest& request, StageTimes& times) {
  const image::Camera camera = product_camera(request.output);
  const image::Camera sky_camera = image::strip_camera(camera, kSkySide);
  const auto sky = request.light.picture(sky_camera, Disc::without, times);
  if (!sky) return sky.error();
  image::FrameBuffer map;
  {
    const StageTimer timer(times, Stage::product);
    const auto disc = disc_lights(request);
    map = image::irradiance_map(camera, sky_camera, *sky, disc);
    set_level_ground(camera, level_ground(sky_camera, *sky, disc), map);
  }
  const std::string unit = "irradiance by the direction of the normal; 1.0 is 683 lux";
  const output::SampleType type = stored_type(request, map);
  std::vector<ProductFile> files;
  if (request.output.format == "ktx2") {
    auto file = cube_texture_of({&map, 1}, camera, type, request.meta, request.output.orientation,
                                {{"skylapse:quantity", unit}}, times);
    if (!file) return file.error();
    files.push_back(*std::move(file));
  } else {
    auto made = picture_files(request, map, type, {{"skylapse:quantity", unit}}, times);
    if (!made) return made.error();
    files = *std::move(made);
  }
  round_as_stored(request.output.format, type, map);
  const double lux = horizontal_lux(request.light, mean_of(zenith_pixels(camera, map)));
  for (ProductFile& file : files)
    file.encoding = {{"horizontal_lux", lux},
                     {"true_horizontal_lux", true_horizontal_lux(request)},
                     {"stored_bits", stored_bits(type)}};
  return files;
}

}  // namespace skylapse::pipeline
