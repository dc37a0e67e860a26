#include "pipeline/frame_light.h"

#include <algorithm>

#include "color/rgb_space.h"
#include "image/irradiance.h"
#include "pipeline/coarse_picture.h"
#include "plan/effect_planner.h"
#include "sky/level_light.h"

namespace skylapse::pipeline {
namespace {

/// The disc with the effects that the plan takes.
sky::SunDisc disc_with(sky::EffectSet effects, const plan::Frame& frame, sky::SunDisc disc) {
  if (effects.has(sky::Effect::flattening)) disc.flattening = frame.sun_flattening;
  if (!effects.has(sky::Effect::limb_darkening))
    disc.radiance = sky::without_limb_darkening(disc.radiance);
  return disc;
}

/// Such pictures are small: made whole, whatever rows are asked for.
Status fill_averaged(const FrameLight& light, const image::Camera& camera, int n, int first_row,
                     image::FrameBuffer& out) {
  const auto whole =
      averaged_picture(camera, n, [&](const image::Camera& fine, image::FrameBuffer& samples) {
        return light.sky.fill(fine, light.xyz_to_rgb, 0, samples);
      });
  if (!whole) return whole.error();
  std::copy_n(whole->row(first_row), out.data().size(), out.data().begin());
  return Done{};
}

}  // namespace

Status FrameLight::fill_rows(const image::Camera& camera, Disc with, int first_row,
                             image::FrameBuffer& out, StageTimes& times) const {
  {
    const StageTimer timer(times, Stage::sky);
    // Paths are drawn for the pixels that were asked for.
    const int n = sky.noise ? 1 : finer_samples(camera);
    const Status filled = n > 1 ? fill_averaged(*this, camera, n, first_row, out)
                                : sky.fill(camera, xyz_to_rgb, first_row, out);
    if (!filled) return filled;
  }
  if (with == Disc::with) add_disc_rows(camera, first_row, out, times);
  return Done{};
}

void FrameLight::add_disc_rows(const image::Camera& camera, int first_row, image::FrameBuffer& out,
                               StageTimes& times) const {
  if (!disc_shows) return;
  const StageTimer timer(times, Stage::disc);
  auto projected = sky::project_sun_disc(camera, disc);
  if (image::sees_upper_hemisphere(camera)) {
    const glm::dvec3 of_disc = sky::disc_energy(disc).horizontal_irradiance;
    const glm::dvec3 of_sky = glm::max(xyz_to_rgb * sky.sky_irradiance_xyz, 0.0);
    sky::sink_to_level(camera, of_disc + kLevelSlack * (of_disc + of_sky), projected);
  }
  sky::add_rows(projected, first_row, out);
}

Result<image::FrameBuffer> FrameLight::picture(const image::Camera& camera, Disc with,
                                               StageTimes& times) const {
  image::FrameBuffer out(camera.width, camera.height);
  const Status filled = fill_rows(camera, with, 0, out, times);
  if (!filled) return filled.error();
  return out;
}

Result<FrameLight> light_of_frame(const plan::Plan& plan, const plan::Frame& frame,
                                  AtmosphereService& atmospheres, StageTimes& times,
                                  const std::function<bool(double)>& progress) {
  const auto space = color::rgb_space_from_name(plan.job.color.space);
  if (!space) return space.error();
  FrameLight light;
  light.xyz_to_rgb = color::xyz_to_rgb(*space);
  {
    const StageTimer timer(times, Stage::atmosphere);
    auto sky = sky_of(plan, frame, atmospheres, progress);
    if (!sky) return sky.error();
    light.sky = *std::move(sky);
  }
  const sky::EffectSet effects = plan::effects_of(plan, frame);
  light.disc_shows = effects.has(sky::Effect::sun_disc);
  light.disc = disc_with(effects, frame, light.sky.disc);
  light.disc_energy = sky::disc_energy(light.disc);
  light.disc.radiance = [matrix = light.xyz_to_rgb, radiance = light.disc.radiance](
                            Angle view_elevation, double limb) {
    return glm::max(matrix * radiance(view_elevation, limb), 0.0);
  };
  return light;
}

}  // namespace skylapse::pipeline
