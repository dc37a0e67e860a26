#include "image/lighting/sources.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "image/camera/cube.h"
#include "image/camera/planar.h"

namespace skylapse::image {
namespace {

/// Of a face's pixels in reading order; all six faces are alike.
std::vector<double> face_solid_angles(int side) {
  std::vector<double> sr(size_t(side) * size_t(side));
  parallel_for_ranges(size_t(side), 32, [&](size_t begin, size_t end) {
    for (size_t y = begin; y < end; ++y)
      for (size_t x = 0; x < size_t(side); ++x) {
        const double s = 2.0 * double(x) / side - 1, t = 2.0 * double(y) / side - 1;
        sr[y * size_t(side) + x] = solid_angle_sr({s, s + 2.0 / side, t, t + 2.0 / side});
      }
  });
  return sr;
}

glm::dvec3 flux_of(const FrameBuffer& strip, const std::vector<double>& sr) {
  glm::dvec3 flux{0};
  for (int face = 0; face < 6; ++face) {
    const float* p = strip.row(face * strip.width());
    for (const double omega : sr) {
      flux += omega * glm::dvec3(p[0], p[1], p[2]);
      p += 3;
    }
  }
  return flux;
}

}  // namespace

glm::dvec3 flux_of(const FrameBuffer& strip) {
  assert(strip.height() == 6 * strip.width());
  return flux_of(strip, face_solid_angles(strip.width()));
}

SphereSources sources_of(const Camera& like, const FrameBuffer& strip) {
  const int side = strip.width();
  assert(strip.height() == 6 * side);
  const std::vector<double> sr = face_solid_angles(side);
  SphereSources sources;
  // Through float: a constant sky's mean is then its value.
  sources.reference = glm::vec3(flux_of(strip, sr) / (4 * std::numbers::pi));
  sources.pieces.resize(strip.pixel_count());
  parallel_for_ranges(size_t(strip.height()), 32, [&](size_t begin, size_t end) {
    for (size_t row = begin; row < end; ++row) {
      const auto axes = cube_face_axes(CubeLayout::vertical_strip, kCubeFaces[row / size_t(side)]);
      const glm::dmat3 face = like.camera_to_enu * glm::dmat3(axes.right, axes.up, axes.forward);
      const size_t y = row % size_t(side);
      const float* p = strip.row(int(row));
      for (size_t x = 0; x < size_t(side); ++x, p += 3) {
        const glm::dvec3 v{(2.0 * double(x) + 1) / side - 1, 1 - (2.0 * double(y) + 1) / side, 1};
        const glm::vec3 d(face * v / std::sqrt(glm::dot(v, v)));
        const glm::vec3 over(glm::dvec3(p[0], p[1], p[2]) - sources.reference);
        sources.pieces[row * size_t(side) + x] = {
            d.x, d.y, d.z, float(sr[y * size_t(side) + x]), over.x, over.y, over.z, 0};
      }
    }
  });
  return sources;
}

}  // namespace skylapse::image
