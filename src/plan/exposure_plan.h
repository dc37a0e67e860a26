#pragma once
#include <memory>
#include <vector>

#include "plan/plan.h"

namespace skylapse::plan {

/// Fills Frame::ev for all frames. Sun curve and fixed exposure need the sun alone; `metered`
/// reads the sky model's own light in each frame and follows it with the rate limit inside a
/// sequence.
Status plan_exposure(Plan& plan);

/// Reads the light of a plan's model: the mean luminance of a frame's sky without the disc, its
/// horizontal illuminance by the sky divided by pi; extrapolation included. Horizontal light with
/// the sun in it would underrate a sky whose sun is low.
/// A computed atmosphere is read on the ground below the camera, by the double twin with draft
/// tables of kMeterBands wavelengths: within a few percent of the picture's own light, and a plan
/// needs no GL. Tables are made when a frame with another air comes along.
class SkyMeter {
 public:
  explicit SkyMeter(const Plan& plan);  // which must outlive the meter
  ~SkyMeter();
  SkyMeter(const SkyMeter&) = delete;
  SkyMeter& operator=(const SkyMeter&) = delete;

  Result<Luminance> read(const Frame& frame);

  static constexpr int kMeterBands = 4;

 private:
  struct Air;
  const Plan& plan_;
  std::unique_ptr<Air> air_;
};

}  // namespace skylapse::plan
