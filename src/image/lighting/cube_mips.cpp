#include "image/lighting/cube_mips.h"

#include <algorithm>
#include <cassert>

#include "core/parallel.h"
#include "image/camera/planar.h"

namespace skylapse::image {
namespace {

/// Where a pixel of a side cut into `to` meets pixels of the same side cut into `from`.
struct Overlap {
  int pixel;          // of the finer cut
  double begin, end;  // on the face's plane, -1 to 1
};

std::vector<std::vector<Overlap>> overlaps(int from, int to) {
  std::vector<std::vector<Overlap>> all(static_cast<size_t>(to));
  const auto place = [](int64_t numerator, int64_t parts) {
    return 2 * double(numerator) / double(parts) - 1;
  };
  const int64_t f = from, t = to;  // in units of 1 / (from to)
  for (int64_t i = 0; i < t; ++i)
    for (int64_t k = i * f / t; k < from && k * t < (i + 1) * f; ++k)
      all[size_t(i)].push_back({int(k), place(std::max(i * f, k * t), f * t),
                                place(std::min((i + 1) * f, (k + 1) * t), f * t)});
  return all;
}

}  // namespace

int level_side(int side, int level) { return std::max(1, level < 31 ? side >> level : 0); }

int level_count(int side, int smallest) {
  int levels = 1;
  while (level_side(side, levels - 1) > std::max(1, smallest)) ++levels;
  return levels;
}

Camera strip_camera(const Camera& like, int side) {
  Camera camera;
  camera.projection = Projection::cube;
  camera.cube_layout = CubeLayout::vertical_strip;
  camera.width = side;
  camera.height = 6 * side;
  camera.camera_to_enu = like.camera_to_enu;
  return camera;
}

FrameBuffer shrunk_cube(const FrameBuffer& strip, int side) {
  const int from = strip.width();
  assert(strip.height() == 6 * from && side >= 1 && side <= from);
  FrameBuffer out(side, 6 * side);
  const auto parts = overlaps(from, side);
  parallel_for_ranges(size_t(side), 4, [&](size_t begin, size_t end) {
    for (size_t y = begin; y < end; ++y)
      for (size_t x = 0; x < size_t(side); ++x) {
        glm::dvec3 sums[6] = {};
        double whole = 0;
        for (const Overlap& v : parts[y])
          for (const Overlap& u : parts[x]) {
            const double sr = solid_angle_sr({u.begin, u.end, v.begin, v.end});
            whole += sr;
            for (int face = 0; face < 6; ++face) {
              const float* p = strip.pixel(u.pixel, face * from + v.pixel);
              sums[face] += sr * glm::dvec3(p[0], p[1], p[2]);
            }
          }
        for (int face = 0; face < 6; ++face)
          for (int c = 0; c < 3; ++c)
            out.pixel(int(x), face * side + int(y))[c] = float(sums[face][c] / whole);
      }
  });
  return out;
}

std::vector<FrameBuffer> box_mips(FrameBuffer strip, int levels) {
  const int side = strip.width();
  std::vector<FrameBuffer> all;
  all.push_back(std::move(strip));
  for (int level = 1; level < levels; ++level)
    all.push_back(shrunk_cube(all.back(), level_side(side, level)));
  return all;
}

}  // namespace skylapse::image
