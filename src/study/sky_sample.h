#pragma once
// The picture that a study renders, and those of its pixels that it compares with the truth.
//
// The picture is a lat-long map of 540 x 270 pixels whose centre is the sun's azimuth, so that left
// and right are mirror images. Its upper half is cut into cells, finer about the sun and near the
// horizon, each an odd number of pixels wide and high; the middle pixel stands for the cell. One
// truth serves a cell and its mirror image. Each tenth degree of the base grid is also a pixel of a
// map of 36 x 18 pixels, for models that are too slow for the large one.
#include <vector>

#include "image/camera/camera.h"
#include "image/frame_buffer.h"
#include "study/sky_error.h"

namespace skylapse::study {

inline constexpr int kStudyWidth = 540, kStudyHeight = 270;
/// Pixels of the large map that one of the small map covers, a side.
inline constexpr int kSmallMapFactor = 15;

/// The large map, or the small one, with the sun's azimuth in its middle column.
image::Camera study_camera(const Direction<Enu>& sun);
image::Camera small_study_camera(const Direction<Enu>& sun);

/// How finely the sky is sampled: some 270 truths, or some 90.
enum class Sampling { full, quick };

/// One truth: a direction on the left of the sun's meridian, and the pixels that it judges.
struct SamplePoint {
  Direction<Enu> toward;
  SolidAngle solid_angle;  // of the cell, without its mirror image
  int x = 0, y = 0;        // the pixel of the large map
  int mirror_x = 0;        // the pixel's mirror image in the same row
  /// The pixel of the small map with the same centre, -1 where there is none, and what it stands
  /// for there, again without its mirror image.
  int small_x = -1, small_y = -1;
  SolidAngle small_solid_angle;
};

/// The sky above `geometry.horizon`. The cells that touch the horizon begin half a pixel above it,
/// where no pixel is a mixture of sky and ground.
std::vector<SamplePoint> sample_points(const SkyGeometry& geometry, Sampling sampling);

/// The points that the small map knows too.
std::vector<SamplePoint> points_of_small_map(const std::vector<SamplePoint>& points);

/// Which of the two maps.
enum class MapSize { large, small };

/// Both sides of the meridian, in the order: point 0, its mirror image, point 1, ...
std::vector<SkyDirection> directions_of(const std::vector<SamplePoint>& points,
                                        const SkyGeometry& geometry, MapSize size);

/// XYZ of the points' pixels in a map of that size (asserted), in the order of directions_of.
std::vector<glm::dvec3> pixels_of(const std::vector<SamplePoint>& points,
                                  const image::FrameBuffer& map, MapSize size,
                                  const glm::dmat3& rgb_to_xyz);

/// Each of `values`, one a point, twice: for the direction and its mirror image.
template <class Value>
std::vector<Value> mirrored(const std::vector<Value>& values) {
  std::vector<Value> both;
  for (const Value& value : values) both.insert(both.end(), 2, value);
  return both;
}

}  // namespace skylapse::study
