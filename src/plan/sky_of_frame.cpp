#include "plan/sky_of_frame.h"

#include "core/constants.h"
#include "plan/baseline_of_frame.h"

namespace skylapse::plan {

sky::AlbedoSpectrum ground_of_frame(const config::JobConfig& job, const Frame& frame) {
  const config::Albedo& albedo = job.air.ground_albedo[frame.albedo].value;
  if (albedo.spectral)
    if (const auto bands = sky::albedo_bands(albedo.name)) return *bands;
  return sky::grey_bands(albedo.value);
}

Result<Illuminance> sky_at_horizon(const config::JobConfig& job, int turbidity, int albedo) {
  if (is_baseline(job.sky.model)) return Illuminance{};
  Frame frame;
  frame.turbidity = turbidity, frame.albedo = albedo;
  frame.sky.sun_radius = kSolarRadiusAt1Au;
  const auto sky = sky_of_frame(job, frame);
  if (!sky) return sky.error();
  return sky->diffuse_irradiance_xyz().y * kLuminousEfficacy * lux;
}

Result<sky::hosek_wilkie::Sky> sky_of_frame(const config::JobConfig& job, const Frame& frame) {
  return sky::hosek_wilkie::Sky::make(
      job.sky.fit, job.sky.solar_flux, job.air.turbidity[frame.turbidity].value,
      ground_of_frame(job, frame), frame.sun.elevation, frame.sky.sun_radius);
}

}  // namespace skylapse::plan
