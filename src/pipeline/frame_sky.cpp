#include "pipeline/frame_sky.h"

#include <memory>

#include "pipeline/reference_sky.h"
#include "plan/baseline_of_frame.h"
#include "plan/effect_planner.h"
#include "plan/sky_of_frame.h"
#include "sky/bruneton/slice_image.h"
#include "sky/fitted_sky.h"
#include "sky/hosek_wilkie/sky_image.h"
#include "sky/hosek_wilkie/sky_image_gpu.h"

namespace skylapse::pipeline {
namespace {

/// On the CPU, or on `context`, which is not null for the model on GL.
Result<FrameSky> hosek_wilkie_sky(const plan::Plan& plan, const plan::Frame& frame,
                                  const std::shared_ptr<gpu::Context>& context) {
  auto made = plan::sky_of_frame(plan.job, frame);
  if (!made) return made.error();
  const auto sky = std::make_shared<const sky::hosek_wilkie::Sky>(*std::move(made));
  const plan::SunForSky sun = frame.sun;
  const double level = sun.twilight_level * sun.distance_factor;
  const bool ground = plan::effects_of(plan, frame).has(sky::Effect::ground);
  FrameSky out;
  out.sky_irradiance_xyz = sky->diffuse_irradiance_xyz() * level;
  out.fill = [=](const image::Camera& camera, const glm::dmat3& xyz_to_rgb, int first_row,
                 image::FrameBuffer& scene) -> Status {
    const glm::dvec3 ground_rgb =
        ground ? xyz_to_rgb * (sky->ground_radiance_xyz() * level) : glm::dvec3(0);
    const sky::hosek_wilkie::ImageInputs inputs{sky.get(), sun.direction, xyz_to_rgb, level,
                                                glm::max(ground_rgb, 0.0)};
    if (context)
      return sky::hosek_wilkie::render_sky_gpu_rows(*context, camera, inputs, first_row, scene);
    sky::hosek_wilkie::render_sky_rows(camera, inputs, first_row, scene);
    return Done{};
  };
  out.disc = {frame.sky.sun_apparent, frame.sky.sun_radius, [=](Angle view_elevation, double limb) {
                return sky->disc_radiance_xyz(view_elevation, limb) * sun.distance_factor;
              }};
  return out;
}

/// Preetham and the CIE general sky.
Result<FrameSky> baseline_sky(const plan::Plan& plan, const plan::Frame& frame) {
  const auto sky = plan::baseline_of_frame(plan.job, plan.model, frame);
  if (!sky) return sky.error();
  const double factor = frame.sun.distance_factor;
  const glm::dvec3 irradiance = sky::dome_irradiance(sky->dome);
  const double albedo = plan.job.air.ground_albedo[frame.albedo].value.value;
  const glm::dvec3 ground = plan::effects_of(plan, frame).has(sky::Effect::ground)
                                ? sky::ground_radiance(*sky, irradiance, albedo)
                                : glm::dvec3(0);
  FrameSky out;
  out.sky_irradiance_xyz = irradiance * factor;
  out.fill = [dome = sky->dome, ground, factor](const image::Camera& camera,
                                                const glm::dmat3& xyz_to_rgb, int first_row,
                                                image::FrameBuffer& scene) -> Status {
    sky::render_dome_rows(camera, dome, factor * xyz_to_rgb, factor * (xyz_to_rgb * ground),
                          first_row, scene);
    return Done{};
  };
  out.disc = sky->disc;
  out.disc.radiance = [radiance = sky->disc.radiance, factor](Angle view_elevation, double limb) {
    return radiance(view_elevation, limb) * factor;
  };
  return out;
}

Result<FrameSky> atmosphere_sky(const plan::Frame& frame, AtmosphereService& atmospheres) {
  auto made = atmospheres.of_frame(frame);
  if (!made) return made.error();
  const auto air = std::make_shared<const FrameAtmosphere>(*std::move(made));
  const plan::SunForSky sun = frame.sun;
  FrameSky out;
  out.sky_irradiance_xyz = air->sky_irradiance_xyz * sun.distance_factor;
  out.fill = [=](const image::Camera& camera, const glm::dmat3& xyz_to_rgb, int first_row,
                 image::FrameBuffer& scene) -> Status {
    sky::bruneton::render_slice_rows(
        camera, {&air->slice, sun.direction, xyz_to_rgb, sun.distance_factor}, first_row, scene);
    return Done{};
  };
  out.disc = {sun.direction, frame.sky.sun_radius,
              [=](Angle view_elevation, double limb) {
                if (!air->disc) return glm::dvec3(0);
                return air->disc->radiance_xyz(view_elevation, limb) * sun.distance_factor;
              },
              frame.horizon};
  return out;
}

}  // namespace

Result<FrameSky> sky_of(const plan::Plan& plan, const plan::Frame& frame,
                        AtmosphereService& atmospheres,
                        const std::function<bool(double)>& progress) {
  if (plan.model == config::SkyModel::reference) return reference_sky(plan, frame, progress);
  if (plan::is_baseline(plan.model)) return baseline_sky(plan, frame);
  if (plan.model == config::SkyModel::hosek_wilkie) return hosek_wilkie_sky(plan, frame, nullptr);
  if (plan.model == config::SkyModel::hosek_wilkie_gl) {
    const auto context = atmospheres.context();
    if (!context) return context.error();
    return hosek_wilkie_sky(plan, frame, *context);
  }
  return atmosphere_sky(frame, atmospheres);
}

}  // namespace skylapse::pipeline
