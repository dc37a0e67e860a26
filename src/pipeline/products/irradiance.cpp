#include "pipeline/products/irradiance.h"

#include <algorithm>
#include <cmath>

#include "image/irradiance.h"
#include "image/lighting/cube_mips.h"
#include "image/lighting/irradiance_map.h"
#include "pipeline/products/cube_texture.h"

namespace skylapse::pipeline {
namespace {

constexpr int kSkySide = 128;

/// What the map says about level ground: its value at the zenith, the mean of the pixels about it.
glm::dvec3 at_zenith(const image::Camera& camera, const image::FrameBuffer& map) {
  const auto up = *image::position_of(camera, enu_direction({}, 90 * deg));
  glm::dvec3 sum{0};
  int count = 0;
  const bool row = camera.projection == image::Projection::lat_long;  // all of the first row
  for (int y = 0; y < camera.height; ++y) {
    if (row ? y > 0 : std::abs(y + 0.5 - up.y) >= 1) continue;
    for (int x = 0; x < camera.width; ++x) {
      if (!row && std::abs(x + 0.5 - up.x) >= 1) continue;
      const float* p = map.pixel(x, y);
      sum += glm::dvec3(p[0], p[1], p[2]);
      ++count;
    }
  }
  return sum / double(count);
}

}  // namespace

Result<std::vector<ProductFile>> make_irradiance(const ProductRequest& request, StageTimes& times) {
  const image::Camera camera = product_camera(request);
  const image::Camera sky_camera = image::strip_camera(camera, kSkySide);
  const auto sky = request.light.picture(sky_camera, Disc::without, times);
  if (!sky) return sky.error();
  image::FrameBuffer map;
  {
    const StageTimer timer(times, Stage::product);
    map = image::irradiance_map(camera, sky_camera, *sky, disc_lights(request));
  }
  const std::string unit = "irradiance by the direction of the normal; 1.0 is 683 lux";
  std::vector<ProductFile> files;
  if (request.output.format == "ktx2") {
    auto file = cube_texture_of({&map, 1}, camera, request.output.sample_type, request.meta,
                                request.output.orientation, {{"skylapse:quantity", unit}}, times);
    if (!file) return file.error();
    files.push_back(*std::move(file));
  } else {
    auto made = picture_files(request, map, {{"skylapse:quantity", unit}}, times);
    if (!made) return made.error();
    files = *std::move(made);
  }
  round_as_stored(request.output.format, request.output.sample_type, map);
  const double lux = horizontal_lux(request.light, at_zenith(camera, map));
  for (ProductFile& file : files)
    file.encoding = {{"horizontal_lux", lux},
                     {"true_horizontal_lux", true_horizontal_lux(request)}};
  return files;
}

}  // namespace skylapse::pipeline
