// Point lights, mirrored by rough surfaces.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/parallel.h"
#include "image/camera/cube.h"
#include "image/lighting/cube_mips.h"
#include "image/lighting/sources.h"
#include "image/lighting/specular.h"

namespace skylapse::image {
namespace {

/// The lights, and what they are from afar.
struct Group {
  std::span<const PointLight> lights;
  glm::dvec3 middle{0};      // unit vector
  glm::dvec3 irradiance{0};  // of all
  double reach = 0;          // chord from the middle to the farthest
};

Group group_of(std::span<const PointLight> lights) {
  Group group{lights};
  for (const PointLight& light : lights) {
    group.irradiance += light.irradiance;
    group.middle +=
        light.direction.vec() * (light.irradiance.x + light.irradiance.y + light.irradiance.z);
  }
  // Lights without light: any direction will do.
  const double length = glm::length(group.middle);
  group.middle = length > 0 ? group.middle / length : lights.front().direction.vec();
  for (const PointLight& light : lights)
    group.reach = std::max(group.reach, glm::length(light.direction.vec() - group.middle));
  return group;
}

/// The kernel changes little over what is this much smaller than its own scale.
constexpr double kSmallOnes = 0.1;

double kernel_scale(double alpha, double chord) { return std::hypot(2 * alpha, chord); }

/// What lights are filtered with.
struct Lobe {
  double alpha;
  GgxKernel kernel{alpha};
};

glm::dvec3 light_at(const Group& group, const Lobe& lobe, const glm::dvec3& d) {
  const auto kernel = [&](const glm::dvec3& to) {
    const glm::dvec3 chord = to - d;
    return lobe.kernel.at_chord2(glm::dot(chord, chord));
  };
  const double chord = std::max(0.0, glm::length(group.middle - d) - group.reach);
  if (group.reach <= kSmallOnes * kernel_scale(lobe.alpha, chord))
    return group.irradiance * kernel(group.middle);
  glm::dvec3 sum{0};
  for (const PointLight& light : group.lights)
    sum += light.irradiance * kernel(light.direction.vec());
  return sum;
}

/// Mean over a pixel, cut as finely as the kernel asks for.
glm::dvec3 light_in_pixel(const Camera& view, const Group& group, const Lobe& lobe, int x, int y) {
  const glm::dvec3 centre = direction_at(view, {x + 0.5, y + 0.5})->vec();
  const double pixel = std::sqrt(pixel_solid_angle(view, x, y).in(sr));
  const double chord = std::max(0.0, glm::length(group.middle - centre) - group.reach - pixel);
  const int cuts = int(std::clamp(
      std::ceil(pixel / (2 * kSmallOnes * kernel_scale(lobe.alpha, chord))), 1.0, 256.0));
  glm::dvec3 sum{0};
  double sr_sum = 0;
  const CubeFace face = kCubeFaces[size_t(y / view.width)];
  for (int v = 0; v < cuts; ++v)
    for (int u = 0; u < cuts; ++u) {
      const PixelPosition p{x + (u + 0.5) / cuts, y + (v + 0.5) / cuts};
      const glm::dvec3 d = to_enu(view, cube_ray(view, face, p)).vec();
      // Solid angle per area of a cube's face: the cube of the cosine to its axis.
      const glm::dvec3 a = glm::abs(d * view.camera_to_enu);
      const double cosine = std::max({a.x, a.y, a.z});
      const double weight = cosine * cosine * cosine;
      sum += weight * light_at(group, lobe, d);
      sr_sum += weight;
    }
  return sum / sr_sum;
}

}  // namespace

void add_filtered_lights(const Camera& camera, std::span<const PointLight> lights, double alpha,
                         FrameBuffer& strip) {
  assert(alpha > 0 && alpha <= 1);
  if (lights.empty()) return;
  const Group group = group_of(lights);
  const Camera view = strip_camera(camera, strip.width());
  const Lobe lobe{alpha};
  std::vector<glm::vec3> light(strip.pixel_count());
  parallel_for_ranges(size_t(view.height), 4, [&](size_t begin, size_t end) {
    for (size_t y = begin; y < end; ++y)
      for (int x = 0; x < view.width; ++x)
        light[y * size_t(view.width) + size_t(x)] =
            glm::vec3(light_in_pixel(view, group, lobe, x, int(y)));
  });
  glm::dvec3 flux{0};
  for (size_t i = 0; i < light.size(); ++i)
    flux +=
        glm::dvec3(light[i]) *
        pixel_solid_angle(view, int(i % size_t(view.width)), int(i / size_t(view.width))).in(sr);
  for (int c = 0; c < 3; ++c) {
    if (!(flux[c] > 0)) continue;
    for (size_t i = 0; i < light.size(); ++i)
      strip.data()[3 * i + size_t(c)] +=
          float(double(light[i][c]) * (group.irradiance[c] / flux[c]));
  }
}

double alpha_for_peak(std::span<const PointLight> lights, double brightest) {
  assert(!lights.empty() && brightest > 0);
  const Group group = group_of(lights);
  const auto peak = [&](double alpha) {
    const glm::dvec3 light = group.irradiance * GgxKernel(alpha).at_chord2(0);
    return std::max({light.x, light.y, light.z});
  };
  double low = 1e-4, high = 1;
  for (int i = 0; i < 50; ++i) {
    const double middle = std::sqrt(low * high);
    (peak(middle) > brightest ? low : high) = middle;
  }
  return high;
}

}  // namespace skylapse::image
