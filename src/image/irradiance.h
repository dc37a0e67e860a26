#pragma once
// What an image shines onto a surface: sums of radiance over its pixels.
#include <glm/glm.hpp>
#include <vector>

#include "image/camera/camera.h"
#include "image/frame_buffer.h"

namespace skylapse::image {

/// Per channel, in the image's radiance unit times steradian. Each pixel counts with the solid
/// angle of pixel_solid_angle and the direction of its centre; sums are in double, and the same
/// for any number of threads.
struct ImageFlux {
  glm::dvec3 total{0};                  // sum of L Omega over all pixels
  glm::dvec3 horizontal_irradiance{0};  // sum of L Omega sin(elevation) over the upper hemisphere
};

/// `camera` and `image` have the same size (asserted). Not-a-number pixels make the sums NaN.
ImageFlux image_flux(const Camera& camera, const FrameBuffer& image);

/// Irradiance of the ground by the image: image_flux(...).horizontal_irradiance.
glm::dvec3 image_irradiance(const Camera& camera, const FrameBuffer& image);

/// Whether a picture shows every direction above the level, so that its horizontal irradiance is
/// that of the scene.
bool sees_upper_hemisphere(const Camera& camera);

/// The same sums for pictures that are made in pieces, and for many pictures of one camera.
class LevelWeights {
 public:
  /// Of the rows [first_row, first_row + rows) of the camera's picture.
  LevelWeights(const Camera& camera, int first_row, int rows);
  /// Adds what the rows [begin, end) of the piece shine onto level ground to `sum`, row by row: the
  /// sum over all rows is the same whatever the pieces, but for the weights' rounding to float that
  /// of image_irradiance. `rgb`: the row `begin`, interleaved, rows without gaps.
  void add_irradiance(const float* rgb, int begin, int end, glm::dvec3& sum) const;
  /// Exchanges two ranges of columns, as a picture may be that is written in another order.
  void exchange_columns(int first, int second, int count);

 private:
  int width_;
  std::vector<double> of_row_;   // lat-long maps: one weight a row
  std::vector<float> of_pixel_;  // the others
};

}  // namespace skylapse::image
