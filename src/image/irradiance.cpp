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

bool sees_upper_hemisphere(const Camera& camera) {
  if (sees_whole_sphere(camera.projection)) return true;
  if (camera.projection == Projection::perspective) return false;
  constexpr Angle kRounding = 1e-9 * rad;
  const auto forward = Direction<Enu>::from_vector(glm::dvec3(camera.camera_to_enu[2]));
  return 0.5 * camera.field_of_view + kRounding >= 180 * deg - elevation(forward);
}

LevelWeights::LevelWeights(const Camera& camera, int first_row, int rows) : width_(camera.width) {
  if (camera.projection == Projection::lat_long) {
    for (int y = first_row; y < first_row + rows; ++y)
      of_row_.push_back(pixel_solid_angle(camera, 0, y).in(sr)*upper_sine(camera, 0, y));
    return;
  }
  of_pixel_.resize(size_t(width_) * rows);
  parallel_for_ranges(size_t(rows), 4, [&](size_t begin, size_t end) {
    for (size_t y = begin; y < end; ++y)
      for (int x = 0; x < width_; ++x) {
        const double sine = upper_sine(camera, x, first_row + int(y));
        of_pixel_[y * width_ + x] =
            sine > 0 ? float(pixel_solid_angle(camera, x, first_row + int(y)).in(sr)*sine) : 0;
      }
  });
}

void LevelWeights::add_irradiance(const float* rgb, int begin, int end, glm::dvec3& sum) const {
  std::vector<glm::dvec3> rows(size_t(end - begin));
  parallel_for_ranges(rows.size(), 16, [&](size_t first, size_t last) {
    for (size_t r = first; r < last; ++r) {
      const float* p = rgb + size_t{3} * width_ * r;
      const size_t y = size_t(begin) + r;
      glm::dvec3 row{0};
      if (!of_row_.empty()) {
        if (of_row_[y] == 0) continue;
        for (int x = 0; x < width_; ++x, p += 3) row += glm::dvec3(p[0], p[1], p[2]);
        row *= of_row_[y];
      } else {
        const float* const weights = of_pixel_.data() + y * width_;
        for (int x = 0; x < width_; ++x, p += 3)
          if (weights[x] > 0) row += double(weights[x]) * glm::dvec3(p[0], p[1], p[2]);
      }
      rows[r] = row;
    }
  });
  for (const glm::dvec3& row : rows) sum += row;  // in a fixed order, whoever summed the rows
}

void LevelWeights::exchange_columns(int first, int second, int count) {
  for (size_t row = 0; row < of_pixel_.size(); row += size_t(width_))
    std::swap_ranges(of_pixel_.begin() + ptrdiff_t(row) + first,
                     of_pixel_.begin() + ptrdiff_t(row) + first + count,
                     of_pixel_.begin() + ptrdiff_t(row) + second);
}

}  // namespace skylapse::image
