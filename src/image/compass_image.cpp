#include "image/compass_image.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/parallel.h"

namespace skylapse::image {
namespace {

constexpr Angle kMarkRadius = 12 * deg;
constexpr Angle kLineHalfWidth = 0.4 * deg;

struct Mark {
  CompassMark name;
  glm::dvec3 direction;
  glm::dvec3 top;                    // towards the upper end of the letter
  std::array<std::uint8_t, 7> rows;  // the letter: five columns, the leftmost in bit 4
};

const std::array<Mark, 6> kMarks{{
    {CompassMark::north, {0, 1, 0}, {0, 0, 1}, {17, 25, 21, 19, 17, 17, 17}},
    {CompassMark::east, {1, 0, 0}, {0, 0, 1}, {31, 16, 16, 30, 16, 16, 31}},
    {CompassMark::south, {0, -1, 0}, {0, 0, 1}, {15, 16, 16, 14, 1, 1, 30}},
    {CompassMark::west, {-1, 0, 0}, {0, 0, 1}, {17, 17, 17, 21, 21, 27, 17}},
    {CompassMark::up, {0, 0, 1}, {0, 1, 0}, {17, 17, 17, 17, 17, 17, 14}},
    {CompassMark::down, {0, 0, -1}, {0, 1, 0}, {30, 17, 17, 17, 17, 17, 30}},
}};

/// Whether the letter covers a direction: it is drawn on the plane that touches the sphere at the
/// mark, seven cells high and two thirds of the disc's diameter tall.
bool in_letter(const Mark& mark, const glm::dvec3& d) {
  const double depth = glm::dot(d, mark.direction);
  const glm::dvec3 right = glm::cross(mark.direction, mark.top);  // forward x up, in east-north-up
  const double cell = tan(kMarkRadius) * 2 / 3 * 2 / 7;
  const int column = static_cast<int>(std::floor(glm::dot(d, right) / depth / cell + 2.5));
  const int row = static_cast<int>(std::floor(3.5 - glm::dot(d, mark.top) / depth / cell));
  if (column < 0 || column > 4 || row < 0 || row > 6) return false;
  return ((mark.rows[row] >> (4 - column)) & 1) != 0;
}

/// Whether an angle lies within the line's half width of a multiple of 30 deg; `scale` widens it
/// where meridians crowd together.
bool on_line(Angle angle, double scale) {
  const double off = std::remainder(angle.in(deg), 30.0);
  return std::abs(off) * scale < kLineHalfWidth.in(deg);
}

glm::vec3 background(const Direction<Enu>& d) {
  const Angle el = elevation(d);
  if (abs(el) < kLineHalfWidth) return {0.1F, 0.7F, 0.1F};
  const glm::vec3 color = d.z() > 0 ? glm::vec3{0.35F, 0.45F, 0.6F} : glm::vec3{0.3F, 0.2F, 0.12F};
  const bool line = on_line(el, 1) || on_line(azimuth(d), cos(el));
  return line ? 0.5F * color : color;
}

glm::vec3 compass_pixel(const Direction<Enu>& d) {
  for (const Mark& mark : kMarks) {
    if (glm::dot(d.vec(), mark.direction) < cos(kMarkRadius)) continue;
    if (!in_letter(mark, d.vec())) return compass_color(mark.name);
    return mark.name == CompassMark::down ? glm::vec3(1) : glm::vec3(0);
  }
  return background(d);
}

}  // namespace

glm::vec3 compass_color(CompassMark mark) {
  switch (mark) {
    case CompassMark::north:
      return {0.9F, 0.05F, 0.05F};
    case CompassMark::east:
      return {0.9F, 0.8F, 0.05F};
    case CompassMark::south:
      return {0.05F, 0.8F, 0.8F};
    case CompassMark::west:
      return {0.1F, 0.2F, 0.95F};
    case CompassMark::up:
      return {1, 1, 1};
    case CompassMark::down:
      break;
  }
  return {0, 0, 0};
}

FrameBuffer compass_image(const Camera& camera) {
  FrameBuffer image(camera.width, camera.height);
  parallel_for_ranges(camera.height, 8, [&](size_t begin, size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < camera.width; ++x) {
        const auto d = direction_at(camera, {x + 0.5, y + 0.5});
        if (!d) continue;
        const glm::vec3 color = compass_pixel(*d);
        std::copy_n(&color.x, 3, image.pixel(x, y));
      }
  });
  return image;
}

}  // namespace skylapse::image
