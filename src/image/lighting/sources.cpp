#include "image/lighting/sources.h"

#include <numbers>

#include "core/parallel.h"
#include "image/irradiance.h"
#include "image/lighting/cube_mips.h"

namespace skylapse::image {

glm::dvec3 flux_of(const FrameBuffer& strip) {
  return image_flux(strip_camera({}, strip.width()), strip).total;
}

SphereSources sources_of(const Camera& like, const FrameBuffer& strip) {
  const Camera camera = strip_camera(like, strip.width());
  SphereSources sources;
  // Through float: a constant sky's mean is then its value.
  sources.reference = glm::vec3(flux_of(strip) / (4 * std::numbers::pi));
  sources.pieces.resize(strip.pixel_count());
  parallel_for_ranges(strip.pixel_count(), 4096, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const int x = int(i % size_t(strip.width())), y = int(i / size_t(strip.width()));
      const glm::vec3 d(direction_at(camera, {x + 0.5, y + 0.5})->vec());
      const float* p = strip.pixel(x, y);
      const glm::vec3 over(glm::dvec3(p[0], p[1], p[2]) - sources.reference);
      sources.pieces[i] = {d.x,    d.y,    d.z,    float(pixel_solid_angle(camera, x, y).in(sr)),
                           over.x, over.y, over.z, 0};
    }
  });
  return sources;
}

}  // namespace skylapse::image
