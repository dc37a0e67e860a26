#include "pipeline/coarse_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "image/irradiance.h"
#include "sky/level_light.h"

namespace skylapse::pipeline {
namespace {

/// Pixels of the mean size of the picture's that stand around the horizon.
double pixels_around(const image::Camera& camera) {
  using enum image::Projection;
  const double side = std::min(camera.width, camera.height);
  switch (camera.projection) {
    case lat_long:
      return std::min(camera.width, 2 * camera.height);
    case cube:  // all layouts are as wide as a number of faces
      return 4.0 * camera.width /
             (camera.cube_layout == image::CubeLayout::horizontal_strip ? 6
              : camera.cube_layout == image::CubeLayout::vertical_strip ? 1
              : camera.cube_layout == image::CubeLayout::cross          ? 4
                                                                        : 3);
    case octahedral:  // 4 pi over side^2 pixels
      return std::sqrt(std::numbers::pi) * side;
    case mirror_ball:  // over the circle's pixels
      return 0.5 * std::numbers::pi * side;
    case fisheye_equidistant:
    case fisheye_equisolid:
    case fisheye_stereographic:
    case perspective:
      break;
  }
  return side * (360 * deg / camera.field_of_view);
}

}  // namespace

int finer_samples(const image::Camera& camera) {
  if (!image::sees_upper_hemisphere(camera)) return 1;
  return std::max(1, int(std::ceil(kFineAround / pixels_around(camera) - 1e-9)));
}

Result<image::FrameBuffer> averaged_picture(
    const image::Camera& camera, int n,
    const std::function<Status(const image::Camera&, image::FrameBuffer&)>& fill) {
  image::Camera fine = camera;
  fine.width *= n, fine.height *= n;
  image::FrameBuffer samples(fine.width, fine.height);
  if (const Status filled = fill(fine, samples); !filled) return filled.error();
  image::FrameBuffer out(camera.width, camera.height);
  parallel_for_ranges(size_t(camera.height), 1, [&](size_t begin, size_t end) {
    for (int y = int(begin); y < int(end); ++y)
      for (int x = 0; x < camera.width; ++x) {
        if (!image::direction_at(camera, {x + 0.5, y + 0.5})) continue;
        glm::dvec3 sum{0};
        double weight = 0;
        for (int j = y * n; j < (y + 1) * n; ++j)
          for (int i = x * n; i < (x + 1) * n; ++i) {
            const double w = image::pixel_solid_angle(fine, i, j).in(sr);
            const float* const p = samples.pixel(i, j);
            sum += w * glm::dvec3(p[0], p[1], p[2]);
            weight += w;
          }
        if (weight == 0) continue;
        for (int c = 0; c < 3; ++c) out.pixel(x, y)[c] = float(sum[c] / weight);
      }
  });
  sky::sink_to_level(camera, image::image_irradiance(fine, samples), out);
  return out;
}

}  // namespace skylapse::pipeline
