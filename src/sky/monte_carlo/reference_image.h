#pragma once
// Pictures by the path tracer: any camera, with a standard error for every value.
#include <functional>

#include "image/camera/camera.h"
#include "image/frame_buffer.h"
#include "sky/monte_carlo/path.h"
#include "sky/monte_carlo/reference.h"

namespace skylapse::sky::monte_carlo {

/// XYZ [W m^-2 sr^-1 with CIE weights, 1 au] with the covariance of the estimate.
struct ColourEstimate {
  glm::dvec3 xyz{0};
  glm::dmat3 covariance{0};
  long paths = 0;
  /// Largest standard error of X, Y and Z over its value; 0 where there is no light.
  [[nodiscard]] double relative_error() const;
};

/// Part of what a pixel sees; weights of a pixel sum to 1.
struct WeightedDirection {
  Direction<Enu> direction;
  double weight = 1;
};

/// One medium, observer and sun, for many directions.
class ReferenceScene {
 public:
  /// Domain: a medium that passes check(), height >= 0 (asserted).
  ReferenceScene(const atmosphere::Medium& medium, Length height, const Direction<Enu>& sun,
                 const ReferenceOptions& options);

  /// The weighted mean of the radiances of some directions, which share the paths that the options
  /// allow. `stream` keys the random numbers.
  [[nodiscard]] ColourEstimate radiance(const std::vector<WeightedDirection>& directions,
                                        uint32_t stream) const;
  /// Per band, from the observer towards a zenith angle to space; 0 through the planet.
  [[nodiscard]] std::vector<double> transmittance(Angle zenith) const;
  [[nodiscard]] const ReferenceOptions& options() const { return options_; }

 private:
  std::vector<glm::dvec3> xyz_weights_;
  ReferenceOptions options_;
  Optics optics_;
  double height_;
  glm::dvec3 to_sun_;
};

struct ReferenceImageInputs {
  const ReferenceScene* scene = nullptr;  // not null
  Angle horizon{};                        // elevation of the scene's horizon
  glm::dmat3 xyz_to_rgb{1.0};             // to the linear space of the image
  double scale = 1.0;                     // factor on everything (distance of the sun)
  /// Told the share of the pixels that is done, answers whether to go on; from one thread at a
  /// time.
  std::function<bool(double)> progress{};
};

/// What an image cost and how sure it is.
struct ReferenceImageRecord {
  long paths = 0;
  /// Of luminance; over the pixels that hold light.
  double mean_relative_error = 0, max_relative_error = 0;
  /// Share of those pixels that have the relative error of the options; 1 where none was asked for.
  double share_reached = 1;
};

/// Fills every pixel of `out` and of `standard_error`, whose sizes are the camera's, as
/// bruneton::render_slice does: without the sun's disc, 0 where the camera sees nothing.
///
/// All paths of a pixel start along its centre, so that they share the table of their first
/// collision and the picture can be held against those of the other models, which are made of
/// centres too. Within kMeanPixels of the horizon a pixel is a mean over its height, as in those:
/// kRowsOfPixel directions share its paths.
///
/// Pixels end at options.samples paths, or where X, Y and Z have options.relative_error. Negative
/// results (colours outside the space) become 0. Deterministic: the same bits on any number of
/// threads. Errors: interrupted.
Result<ReferenceImageRecord> render_reference(const image::Camera& camera,
                                              const ReferenceImageInputs& inputs,
                                              image::FrameBuffer& out,
                                              image::FrameBuffer& standard_error);

/// The same for the rows [first_row, first_row + out.height()) of the camera's image, with the
/// bits that the whole image has there; both buffers are as wide as that, `progress` and the record
/// are of these rows.
Result<ReferenceImageRecord> render_reference_rows(const image::Camera& camera,
                                                   const ReferenceImageInputs& inputs,
                                                   int first_row, image::FrameBuffer& out,
                                                   image::FrameBuffer& standard_error);

inline constexpr int kRowsOfPixel = 8;

}  // namespace skylapse::sky::monte_carlo
