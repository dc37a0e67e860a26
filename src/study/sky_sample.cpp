#include "study/sky_sample.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace skylapse::study {
namespace {

/// Pixels of the large map, from its upper left corner.
struct Cell {
  int x, y, width, height;
  [[nodiscard]] int centre_x() const { return x + width / 2; }
  [[nodiscard]] int centre_y() const { return y + height / 2; }
};

constexpr int kBase = kSmallMapFactor;  // 10 deg
constexpr int kHalf = kStudyWidth / 2;  // the left half: columns 0 .. kHalf - 1
constexpr double kRowDeg = 180.0 / kStudyHeight;

image::Camera lat_long(const Direction<Enu>& sun, int width, int height) {
  image::Camera camera;
  camera.projection = image::Projection::lat_long;
  camera.width = width, camera.height = height;
  camera.camera_to_enu = image::look_at(azimuth(sun), 0 * deg, 0 * deg);
  return camera;
}

Direction<Enu> direction_of(const image::Camera& camera, int x, int y) {
  return *image::direction_at(camera, {x + 0.5, y + 0.5});
}

SolidAngle solid_angle_of(const image::Camera& camera, const Cell& cell) {
  SolidAngle sum;
  for (int y = cell.y; y < cell.y + cell.height; ++y)
    sum += double(cell.width) * image::pixel_solid_angle(camera, cell.x, y);
  return sum;
}

class Sampler {
 public:
  Sampler(const SkyGeometry& geometry, Sampling sampling)
      : geometry_(geometry), sampling_(sampling), camera_(study_camera(geometry.sun)) {
    // The first row wholly below the last pixel that may hold ground.
    const double rows = (90 * deg - geometry.horizon).in(deg) / kRowDeg;
    end_row_ = int(std::floor(rows + 1e-9));
  }

  std::vector<SamplePoint> points() {
    const int columns = sampling_ == Sampling::quick ? 3 : 1;
    // Above 60 deg of elevation a cell of 10 deg of azimuth is hardly wider than the sun's aureole
    // is deep: three are one.
    for (int y = 0; y + kBase <= kStudyHeight / 2; y += kBase) {
      const bool high = y < 3 * kBase, lowest = y + kBase == kStudyHeight / 2;
      const int width = kBase * (high ? 3 : columns);
      for (int x = 0; x + width <= kHalf; x += width) {
        const Cell cell{x, y, width, kBase};
        const size_t first = points_.size();
        if (lowest)
          add_ring(cell);
        else
          add(cell);
        share_among_small_pixels(cell, first);
      }
    }
    add_below_level(columns);
    return std::move(points_);
  }

 private:
  /// The points from `first` on are those of a cell of the base grid: its solid angle belongs to
  /// the pixels of the small map among them, one or three.
  void share_among_small_pixels(const Cell& base, size_t first) {
    const auto in_small = [](const SamplePoint& p) { return p.small_x >= 0; };
    const auto begin = points_.begin() + long(first);
    const long count = std::count_if(begin, points_.end(), in_small);
    for (auto p = begin; p != points_.end(); ++p)
      if (in_small(*p)) p->small_solid_angle = solid_angle_of(camera_, base) / double(count);
  }

  /// Rows of the ring, from its top: 5 pixels, 5, 1, 3, 1.
  void add_ring(const Cell& ring) {
    int y = ring.y;
    for (const int height : {5, 5, 1, 3, 1}) {
      add({ring.x, y, ring.width, height});
      y += height;
    }
  }

  /// Sky below elevation 0, which a camera high up sees: rows in threes, the rest one by one.
  void add_below_level(int columns) {
    const int width = kBase * columns;
    for (int y = kStudyHeight / 2; y < end_row_;) {
      const int height = y + 3 <= end_row_ ? 3 : 1;
      for (int x = 0; x + width <= kHalf; x += width) add({x, y, width, height});
      y += height;
    }
  }

  /// Adds the cell, or where it lies in the aureole its parts.
  void add(const Cell& cell) {
    const int parts_x = cell.width % 3 == 0 && cell.width > 5 ? 3 : cell.width == 5 ? 5 : 1;
    const int parts_y = cell.height == 15 ? 3 : cell.height == 5 ? 5 : 1;
    if (!near_sun(cell) || (parts_x == 1 && parts_y == 1)) return keep(cell);
    const int w = cell.width / parts_x, h = cell.height / parts_y;
    for (int j = 0; j < parts_y; ++j)
      for (int i = 0; i < parts_x; ++i) add({cell.x + i * w, cell.y + j * h, w, h});
  }

  /// Whether the aureole changes much over the cell: its nearest corner is closer to the sun than
  /// the cell is large, but no cell need be smaller than half a degree from the sun.
  [[nodiscard]] bool near_sun(const Cell& cell) const {
    const Direction<Enu> centre = direction_of(camera_, cell.centre_x(), cell.centre_y());
    const double side = std::sqrt(solid_angle_of(camera_, cell).in(sr));
    const double finest = sampling_ == Sampling::quick ? 0.7 : 1.2;
    return separation(centre, geometry_.sun).in(rad) < finest * side;
  }

  void keep(const Cell& cell) {
    SamplePoint p;
    p.x = cell.centre_x(), p.y = cell.centre_y();
    p.mirror_x = kStudyWidth - 1 - p.x;
    p.toward = direction_of(camera_, p.x, p.y);
    p.solid_angle = solid_angle_of(camera_, cell);
    const bool level = p.y < kStudyHeight / 2;
    if (level && p.x % kBase == kBase / 2 && p.y % kBase == kBase / 2)
      p.small_x = p.x / kBase, p.small_y = p.y / kBase;
    points_.push_back(p);
  }

  SkyGeometry geometry_;
  Sampling sampling_;
  image::Camera camera_;
  int end_row_ = 0;
  std::vector<SamplePoint> points_;
};

}  // namespace

image::Camera study_camera(const Direction<Enu>& sun) {
  return lat_long(sun, kStudyWidth, kStudyHeight);
}

image::Camera small_study_camera(const Direction<Enu>& sun) {
  return lat_long(sun, kStudyWidth / kSmallMapFactor, kStudyHeight / kSmallMapFactor);
}

std::vector<SamplePoint> sample_points(const SkyGeometry& geometry, Sampling sampling) {
  return Sampler(geometry, sampling).points();
}

std::vector<SamplePoint> points_of_small_map(const std::vector<SamplePoint>& points) {
  std::vector<SamplePoint> known;
  for (const SamplePoint& p : points)
    if (p.small_x >= 0) known.push_back(p);
  return known;
}

std::vector<SkyDirection> directions_of(const std::vector<SamplePoint>& points,
                                        const SkyGeometry& geometry, MapSize size) {
  const image::Camera camera = study_camera(geometry.sun);
  std::vector<SkyDirection> directions;
  for (const SamplePoint& p : points) {
    const SolidAngle weight = size == MapSize::large ? p.solid_angle : p.small_solid_angle;
    directions.push_back({p.toward, weight});
    directions.push_back({direction_of(camera, p.mirror_x, p.y), weight});
  }
  return directions;
}

std::vector<glm::dvec3> pixels_of(const std::vector<SamplePoint>& points,
                                  const image::FrameBuffer& map, MapSize size,
                                  const glm::dmat3& rgb_to_xyz) {
  const int factor = size == MapSize::large ? 1 : kSmallMapFactor;
  assert(map.width() * factor == kStudyWidth && map.height() * factor == kStudyHeight);
  std::vector<glm::dvec3> xyz;
  const auto at = [&](int x, int y) {
    const float* p = map.pixel(x, y);
    return rgb_to_xyz * glm::dvec3(p[0], p[1], p[2]);
  };
  for (const SamplePoint& p : points) {
    xyz.push_back(at(p.x / factor, p.y / factor));
    xyz.push_back(at(p.mirror_x / factor, p.y / factor));
  }
  return xyz;
}

}  // namespace skylapse::study
