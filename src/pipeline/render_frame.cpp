#include "pipeline/render_frame.h"

#include "color/rgb_space.h"
#include "plan/effect_planner.h"
#include "plan/sky_of_frame.h"
#include "sky/hosek_wilkie/sky_image.h"
#include "sky/sun_disc.h"

namespace skylapse::pipeline {
namespace {

using sky::hosek_wilkie::Sky;

bool has_effect(const std::vector<plan::EffectDecision>& decisions, plan::Effect effect) {
  for (const auto& decision : decisions)
    if (decision.effect == effect) return decision.on;
  return false;
}

}  // namespace

Result<RenderedFrame> render_frame(const plan::Plan& plan, const plan::Frame& frame,
                                   bool keep_without_disc, StageTimes& times) {
  const config::JobConfig& job = plan.job;
  const image::Camera& camera = job.cameras[frame.camera].camera;
  const auto space = color::rgb_space_from_name(job.color.space);
  if (!space) return space.error();
  const glm::dmat3& xyz_to_rgb = color::xyz_to_rgb(*space);
  const auto effects = plan::decide_effects(job, frame);

  const Result<Sky> sky = plan::sky_of_frame(job, frame);
  if (!sky) return sky.error();
  const double level = frame.sun.twilight_level * frame.sun.distance_factor;

  RenderedFrame out;
  {
    const StageTimer timer(times, Stage::sky);
    out.scene = image::FrameBuffer(camera.width, camera.height);
    out.sky_irradiance_xyz = sky->diffuse_irradiance_xyz() * level;
    const glm::dvec3 ground_rgb = xyz_to_rgb * (sky->ground_radiance_xyz() * level);
    sky::hosek_wilkie::render_sky(
        camera, {&*sky, frame.sun.direction, xyz_to_rgb, level, glm::max(ground_rgb, 0.0)},
        out.scene);
  }
  if (keep_without_disc) out.scene_without_disc = out.scene;

  const sky::SunDisc disc{
      frame.sky.sun_apparent, frame.sky.sun_radius, [&](Angle view_elevation, double limb) {
        return sky->disc_radiance_xyz(view_elevation, limb) * frame.sun.distance_factor;
      }};
  const sky::DiscEnergy energy = sky::disc_energy(disc);
  out.sun_irradiance_xyz = energy.horizontal_irradiance;
  out.sun_normal_irradiance_xyz = energy.normal_irradiance;
  if (has_effect(effects, plan::Effect::sun_disc)) {
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
