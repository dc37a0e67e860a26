#include "image/irradiance.h"

#include <algorithm>
#include <vector>

#include "core/parallel.h"

namespace skylapse::image {
namespace {

double upper_sine(const Camera& camera, int x, int y) {
  const auto d = direction_at(camera, {x + 0.5, y + 0.5});
  return d ? std::max(0.0, d->z()) : 0;
}

/// A lat-long map stands upright: one solid angle and one elevation for the whole row.
ImageFlux lat_long_row(const Camera& camera, const FrameBuffer& image, int y) {
  glm::dvec3 sum{0};
  const float* p = image.row(y);
  for (int x = 0; x < image.width(); ++x, p += 3) sum += glm::dvec3(p[0], p[1], p[2]);
  sum *= pixel_solid_angle(camera, 0, y).in(sr);
  return {sum, sum * upper_sine(camera, 0, y)};
}

ImageFlux row_flux(const Camera& camera, const FrameBuffer& image, int y) {
  if (camera.projection == Projection::lat_long) return lat_long_row(camera, image, y);
  ImageFlux flux;
  const float* p = image.row(y);
  for (int x = 0; x < image.width(); ++x, p += 3) {
    const double omega = pixel_solid_angle(camera, x, y).in(sr);
    if (omega == 0) continue;
    const glm::dvec3 contribution = omega * glm::dvec3(p[0], p[1], p[2]);
    flux.total += contribution;
    flux.horizontal_irradiance += contribution * upper_sine(camera, x, y);
  }
  return flux;
}

}  // namespace

ImageFlux image_flux(const Camera& camera, const FrameBuffer& image) {
  assert(camera.width == image.width() && camera.height == image.height());
  std::vector<ImageFlux> rows(image.height());
  parallel_for_ranges(rows.size(), 16, [&](size_t begin, size_t end) {
    for (size_t y = begin; y < end; ++y) rows[y] = row_flux(camera, image, static_cast<int>(y));
  });
  ImageFlux flux;
  for (const ImageFlux& row : rows) {  // in a fixed order, whoever summed the rows
    flux.total += row.total;
    flux.horizontal_irradiance += row.horizontal_irradiance;
  }
  return flux;
}

glm::dvec3 image_irradiance(const Camera& camera, const FrameBuffer& image) {
  return image_flux(camera, image).horizontal_irradiance;
}

}  // namespace skylapse::image
