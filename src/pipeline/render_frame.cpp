#include "pipeline/render_frame.h"

#include "pipeline/frame_light.h"

namespace skylapse::pipeline {

Result<RenderedFrame> render_frame(const plan::Plan& plan, const plan::Frame& frame,
                                   AtmosphereService& atmospheres, bool keep_without_disc,
                                   StageTimes& times, const std::function<bool(double)>& progress) {
  const image::Camera& camera = plan.job.cameras[frame.camera].camera;
  const auto light = light_of_frame(plan, frame, atmospheres, times, progress);
  if (!light) return light.error();
  auto scene = light->picture(camera, Disc::without, times);
  if (!scene) return scene.error();

  RenderedFrame out;
  out.sky_irradiance_xyz = light->sky.sky_irradiance_xyz;
  out.sun_irradiance_xyz = light->disc_energy.horizontal_irradiance;
  out.sun_normal_irradiance_xyz = light->disc_energy.normal_irradiance;
  out.scene = *std::move(scene);
  if (light->sky.noise) out.noise = std::move(*light->sky.noise);
  if (keep_without_disc) out.scene_without_disc = out.scene;
  light->add_disc_rows(camera, 0, out.scene, times);
  return out;
}

}  // namespace skylapse::pipeline
