#include "pipeline/render_frame.h"

#include "color/rgb_space.h"
#include "pipeline/frame_sky.h"
#include "plan/effect_planner.h"

namespace skylapse::pipeline {
namespace {

/// The disc with the effects that the plan takes.
sky::SunDisc disc_with(sky::EffectSet effects, const plan::Frame& frame, sky::SunDisc disc) {
  if (effects.has(sky::Effect::flattening)) disc.flattening = frame.sun_flattening;
  if (!effects.has(sky::Effect::limb_darkening))
    disc.radiance = sky::without_limb_darkening(disc.radiance);
  return disc;
}

}  // namespace

Result<RenderedFrame> render_frame(const plan::Plan& plan, const plan::Frame& frame,
                                   AtmosphereService& atmospheres, bool keep_without_disc,
                                   StageTimes& times, const std::function<bool(double)>& progress) {
  const config::JobConfig& job = plan.job;
  const image::Camera& camera = job.cameras[frame.camera].camera;
  const auto space = color::rgb_space_from_name(job.color.space);
  if (!space) return space.error();
  const glm::dmat3& xyz_to_rgb = color::xyz_to_rgb(*space);

  const auto sky = [&] {
    const StageTimer timer(times, Stage::atmosphere);
    return sky_of(plan, frame, atmospheres, progress);
  }();
  if (!sky) return sky.error();

  RenderedFrame out;
  out.sky_irradiance_xyz = sky->sky_irradiance_xyz;
  {
    const StageTimer timer(times, Stage::sky);
    out.scene = image::FrameBuffer(camera.width, camera.height);
    const Status filled = sky->fill(camera, xyz_to_rgb, out.scene);
    if (!filled) return filled.error();
    if (sky->noise) out.noise = std::move(*sky->noise);
  }
  if (keep_without_disc) out.scene_without_disc = out.scene;

  const sky::EffectSet effects = plan::effects_of(plan, frame);
  const sky::SunDisc disc = disc_with(effects, frame, sky->disc);
  const sky::DiscEnergy energy = sky::disc_energy(disc);
  out.sun_irradiance_xyz = energy.horizontal_irradiance;
  out.sun_normal_irradiance_xyz = energy.normal_irradiance;
  if (effects.has(sky::Effect::sun_disc)) {
    const StageTimer timer(times, Stage::disc);
    sky::SunDisc in_rgb = disc;
    in_rgb.radiance = [&](Angle view_elevation, double limb) {
      return glm::max(xyz_to_rgb * disc.radiance(view_elevation, limb), 0.0);
    };
    sky::add_sun_disc(camera, in_rgb, out.scene);
  }
  return out;
}

}  // namespace skylapse::pipeline
