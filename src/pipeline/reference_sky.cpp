#include "pipeline/reference_sky.h"

#include <algorithm>
#include <memory>

#include "pipeline/disc_of_frame.h"
#include "plan/effect_planner.h"

namespace skylapse::pipeline {
namespace {

namespace mc = sky::monte_carlo;
using sky::atmosphere::Medium;

/// Paths of the horizontal irradiance, at least: some 0.3 % by day.
constexpr long kIrradiancePaths = 32768;

/// Mixes bits: neighbouring moments get unrelated seeds. Source: Steele, Lea & Flood 2014,
/// "Fast splittable pseudorandom number generators" (the finaliser of SplitMix64).
uint64_t mixed(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

struct SkyIrradiance {
  glm::dvec3 xyz{0};
  double relative_error = 0;  // of Y, at most: as if the bands erred together
};

SkyIrradiance irradiance_of(const Medium& medium, const plan::Frame& frame,
                            mc::ReferenceOptions options) {
  SkyIrradiance out;
  if (frame.camera_height.in(km) > medium.top_height_km) return out;  // no sky above
  options.samples = std::max(options.samples, kIrradiancePaths);
  options.relative_error = {};
  const auto found = mc::reference_irradiance(medium, frame.camera_height,
                                              90 * deg - elevation(frame.sun.direction), options);
  double error = 0;
  for (size_t b = 0; b < medium.bands.size(); ++b) {
    out.xyz += found.sky[b] * medium.bands[b].xyz_weight;
    error += found.sky_error[b] * medium.bands[b].xyz_weight.y;
  }
  if (out.xyz.y > 0) out.relative_error = error / out.xyz.y;
  return out;
}

}  // namespace

mc::ReferenceOptions reference_options(const plan::Plan& plan, const plan::Frame& frame) {
  const config::PathSettings& settings = plan.job.sky.paths;
  const uint64_t moment = uint64_t(frame.instant.utc.time_since_epoch().count()) * 2 +
                          uint64_t(frame.instant.leap_second);
  const sky::EffectSet effects = plan::effects_of(plan, frame);
  return {.samples = settings.samples,
          .relative_error = settings.relative_error,
          .seed = mixed(mixed(settings.seed) + moment),
          .max_order = effects.has(sky::Effect::multiple_scattering) ? plan.job.sky.orders : 1,
          .ground = effects.has(sky::Effect::ground)};
}

Result<FrameSky> reference_sky(const plan::Plan& plan, const plan::Frame& frame,
                               const std::function<bool(double)>& progress) {
  const auto medium = plan::medium_of_frame(plan.job, plan.air, frame);
  if (!medium) return medium.error();
  const mc::ReferenceOptions options = reference_options(plan, frame);
  const plan::SunForSky sun = frame.sun;
  const auto scene = std::make_shared<const mc::ReferenceScene>(*medium, frame.camera_height,
                                                                sun.direction, options);
  const SkyIrradiance irradiance = irradiance_of(*medium, frame, options);
  const auto disc =
      disc_of_frame(*medium, frame, [&](Angle zenith) { return scene->transmittance(zenith); });
  FrameSky out;
  out.sky_irradiance_xyz = irradiance.xyz * sun.distance_factor;
  out.noise = std::make_shared<FrameNoise>();
  out.noise->sky_irradiance_error = irradiance.relative_error;
  out.fill = [=, noise = out.noise, horizon = frame.horizon](
                 const image::Camera& camera, const glm::dmat3& xyz_to_rgb, int first_row,
                 image::FrameBuffer& picture) -> Status {
    noise->standard_error = image::FrameBuffer(picture.width(), picture.height());
    const auto record = mc::render_reference_rows(
        camera, {scene.get(), horizon, xyz_to_rgb, sun.distance_factor, progress}, first_row,
        picture, noise->standard_error);
    if (!record) return record.error();
    noise->record = *record;
    return Done{};
  };
  out.disc = {sun.direction, frame.sky.sun_radius,
              [=](Angle view_elevation, double limb) {
                if (!disc) return glm::dvec3(0);
                return disc->radiance_xyz(view_elevation, limb) * sun.distance_factor;
              },
              frame.horizon};
  return out;
}

}  // namespace skylapse::pipeline
