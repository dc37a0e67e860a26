#include "image/lighting/harmonics.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/parallel.h"

namespace skylapse::image {
namespace {

constexpr std::array<int, kHarmonics> kDegree{0, 1, 1, 1, 2, 2, 2, 2, 2};

void add(Harmonics& sum, const std::array<double, kHarmonics>& y, const glm::dvec3& light) {
  for (int i = 0; i < kHarmonics; ++i) sum[i] += y[i] * light;
}

}  // namespace

std::array<double, kHarmonics> harmonics_at(const glm::dvec3& d) {
  constexpr double kInverse4Pi = 0.25 * std::numbers::inv_pi;
  static const double k0 = std::sqrt(kInverse4Pi), k1 = std::sqrt(3 * kInverse4Pi),
                      k2 = std::sqrt(15 * kInverse4Pi), k20 = std::sqrt(5 * kInverse4Pi / 4),
                      k22 = std::sqrt(15 * kInverse4Pi / 4);
  return {k0,
          k1 * d.y,
          k1 * d.z,
          k1 * d.x,
          k2 * d.x * d.y,
          k2 * d.y * d.z,
          k20 * (3 * d.z * d.z - 1),
          k2 * d.x * d.z,
          k22 * (d.x - d.y) * (d.x + d.y)};
}

Harmonics sum_of(const Harmonics& a, const Harmonics& b) {
  Harmonics sum = a;
  for (int i = 0; i < kHarmonics; ++i) sum[i] += b[i];
  return sum;
}

Harmonics project_picture(const Camera& camera, const FrameBuffer& image,
                          const glm::dmat3& enu_to_axes) {
  assert(camera.width == image.width() && camera.height == image.height());
  std::vector<Harmonics> rows(size_t(image.height()), Harmonics{});
  parallel_for_ranges(rows.size(), 16, [&](size_t begin, size_t end) {
    for (size_t row = begin; row < end; ++row)
      for (int x = 0; x < image.width(); ++x) {
        const int y = int(row);
        const auto d = direction_at(camera, {x + 0.5, y + 0.5});
        if (!d) continue;
        const float* p = image.pixel(x, y);
        add(rows[row], harmonics_at(enu_to_axes * d->vec()),
            pixel_solid_angle(camera, x, y).in(sr)*glm::dvec3(p[0], p[1], p[2]));
      }
  });
  Harmonics sum{};
  for (const Harmonics& row : rows)
    sum = sum_of(sum, row);  // in a fixed order, whoever made the rows
  return sum;
}

Harmonics project_lights(std::span<const PointLight> lights, const glm::dmat3& enu_to_axes) {
  Harmonics sum{};
  for (const PointLight& light : lights)
    add(sum, harmonics_at(enu_to_axes * light.direction.vec()), light.irradiance);
  return sum;
}

glm::dvec3 irradiance_of(const Harmonics& light, const glm::dvec3& normal) {
  const auto y = harmonics_at(normal);
  glm::dvec3 sum{0};
  for (int i = 0; i < kHarmonics; ++i) sum += kCosineFactors[size_t(kDegree[i])] * y[i] * light[i];
  return sum;
}

Harmonics cosine_convolved(const Harmonics& light) {
  Harmonics irradiance = light;
  for (int i = 0; i < kHarmonics; ++i) irradiance[i] *= kCosineFactors[size_t(kDegree[i])];
  return irradiance;
}

}  // namespace skylapse::image
