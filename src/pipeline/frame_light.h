#pragma once
// The light of one frame, for every camera and product that asks for it.
#include <functional>
#include <glm/glm.hpp>

#include "pipeline/frame_sky.h"
#include "pipeline/stage_times.h"
#include "plan/plan.h"

namespace skylapse::pipeline {

/// Part of the irradiance of level ground by sky and sun that coarse pixels may add before light of
/// the disc is sunk below the level.
inline constexpr double kLevelSlack = 0.001;

/// What stands in the sky beside the sky.
enum class Disc { with, without };

/// Sky, ground and sun of a frame in the job's scene-linear space, 1.0 standing for 683 cd/m^2.
/// Safe for use by many threads, but for a model that draws paths (`noise` is of the last picture).
struct FrameLight {
  FrameSky sky;
  glm::dmat3 xyz_to_rgb{1.0};
  sky::SunDisc disc;            // in the job's space, negative colours at 0
  bool disc_shows = true;       // the effect is on
  sky::DiscEnergy disc_energy;  // in XYZ, whether it shows or not
  /// Fills the rows [first_row, first_row + out.height()) of the camera's picture; `out` is as wide
  /// as that. A disc that does not show is left out in either case. Coarse pictures that light
  /// scenes are means of finer ones (coarse_picture.h).
  Status fill_rows(const image::Camera& camera, Disc disc, int first_row, image::FrameBuffer& out,
                   StageTimes& times) const;
  /// Adds the disc, if it shows, to such rows. A picture of the whole upper hemisphere, which can
  /// light a scene, keeps the disc's flux and, within kLevelSlack of the irradiance of level
  /// ground, that too: see sky::sink_to_level.
  void add_disc_rows(const image::Camera& camera, int first_row, image::FrameBuffer& out,
                     StageTimes& times) const;
  /// The whole picture.
  Result<image::FrameBuffer> picture(const image::Camera& camera, Disc disc,
                                     StageTimes& times) const;
};

/// Computes what is the same for all pixels. `progress`: as of sky_of.
Result<FrameLight> light_of_frame(const plan::Plan& plan, const plan::Frame& frame,
                                  AtmosphereService& atmospheres, StageTimes& times,
                                  const std::function<bool(double)>& progress = {});

}  // namespace skylapse::pipeline
