#pragma once
// What a job asks to see of the sky of a frame: the pictures and products of all its outputs.
#include <vector>

#include "config/job_config.h"
#include "plan/effects/view_reach.h"

namespace skylapse::plan {

/// All views of the frames of one of the job's cameras.
struct Sight {
  /// Each size and direction once: that of the job's camera first, if an output shows it.
  std::vector<image::Camera> pictures;
  /// A product gathers light from all directions, of whatever size its own pixels are.
  bool all_directions = false;

  /// Of the pictures, and everything if there is such a product.
  [[nodiscard]] ViewReach reach() const;
  /// Smallest and largest pixel of all pictures.
  [[nodiscard]] PixelSides pixels() const;
  /// Whether any part of the disc of angular radius `reach`, widened by `margin` of each picture's
  /// largest pixel, is seen.
  [[nodiscard]] bool sees_disc(const Direction<Enu>& centre, Angle reach, double margin) const;
  /// The views whose skies differ: of those that see the whole sphere the first.
  [[nodiscard]] std::vector<image::Camera> skies() const;
  /// The one picture that all light is computed for; null if there are several or a product.
  [[nodiscard]] const image::Camera* only_picture() const;
};
Sight sight_of(const config::JobConfig& job, const config::CameraConfig& camera);

}  // namespace skylapse::plan
