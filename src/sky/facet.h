#pragma once
// A rectangle of an image that looks through one lens: the whole picture, one face of a cube, or an
// octahedral map.
#include <glm/glm.hpp>
#include <vector>

#include "image/camera/camera.h"

namespace skylapse::sky {

/// Pixels [x_begin, x_end) of one row.
struct PixelSpan {
  int begin = 0, end = 0;
};

struct Facet {
  /// Plane: perspective and cube faces. The others as image::Projection.
  enum class Lens { plane, equidistant, equisolid, stereographic, octahedral };

  Lens lens = Lens::plane;
  int x0 = 0, y0 = 0, width = 0, height = 0;  // pixels of the image
  double centre_x = 0, centre_y = 0;          // where the axis meets the image, in pixels
  double unit_px = 1;      // pixels per unit of x and y: focal length, circle radius, half side
  double lens_factor = 0;  // fisheyes: theta_max / 2, sin(theta_max / 2) or tan(theta_max / 2)
  glm::dmat3 axes{1.0};    // columns right, up, middle in east-north-up (octahedral: forward)

  [[nodiscard]] double x_of(int column) const { return (column + 0.5 - centre_x) / unit_px; }
  [[nodiscard]] double y_of(int row) const { return (centre_y - row - 0.5) / unit_px; }
  /// Direction in east-north-up of lens coordinates (not pixels).
  [[nodiscard]] glm::dvec3 direction(double x, double y) const;
  /// Upper bound of the square root of any pixel's solid angle, in radians.
  [[nodiscard]] double largest_pixel_side() const;
  /// The part of a row that shows something: all of it, or what is inside the image circle.
  [[nodiscard]] PixelSpan visible(int row) const;
};

/// The facets of any camera but lat-long, from left to right. They do not overlap; the blank parts
/// of a cross have none.
std::vector<Facet> facets_of(const image::Camera& camera);

}  // namespace skylapse::sky
