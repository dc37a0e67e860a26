#include "pipeline/frame_sky.h"

#include <memory>

#include "plan/sky_of_frame.h"
#include "sky/bruneton/slice_image.h"
#include "sky/hosek_wilkie/sky_image.h"

namespace skylapse::pipeline {
namespace {

Result<FrameSky> hosek_wilkie_sky(const plan::Plan& plan, const plan::Frame& frame) {
  auto made = plan::sky_of_frame(plan.job, frame);
  if (!made) return made.error();
  const auto sky = std::make_shared<const sky::hosek_wilkie::Sky>(*std::move(made));
  const plan::SunForSky sun = frame.sun;
  const double level = sun.twilight_level * sun.distance_factor;
  FrameSky out;
  out.sky_irradiance_xyz = sky->diffuse_irradiance_xyz() * level;
  out.fill = [=](const image::Camera& camera, const glm::dmat3& xyz_to_rgb,
                 image::FrameBuffer& scene) {
    const glm::dvec3 ground_rgb = xyz_to_rgb * (sky->ground_radiance_xyz() * level);
    sky::hosek_wilkie::render_sky(
        camera, {sky.get(), sun.direction, xyz_to_rgb, level, glm::max(ground_rgb, 0.0)}, scene);
  };
  out.disc = {frame.sky.sun_apparent, frame.sky.sun_radius, [=](Angle view_elevation, double limb) {
                return sky->disc_radiance_xyz(view_elevation, limb) * sun.distance_factor;
              }};
  return out;
}

Result<FrameSky> atmosphere_sky(const plan::Frame& frame, AtmosphereService& atmospheres) {
  auto made = atmospheres.of_frame(frame);
  if (!made) return made.error();
  const auto air = std::make_shared<const FrameAtmosphere>(*std::move(made));
  const plan::SunForSky sun = frame.sun;
  FrameSky out;
  out.sky_irradiance_xyz = air->sky_irradiance_xyz * sun.distance_factor;
  out.fill = [=](const image::Camera& camera, const glm::dmat3& xyz_to_rgb,
                 image::FrameBuffer& scene) {
    sky::bruneton::render_slice(
        camera, {&air->slice, sun.direction, xyz_to_rgb, sun.distance_factor}, scene);
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
                        AtmosphereService& atmospheres) {
  if (plan::is_hosek_wilkie(plan.model)) return hosek_wilkie_sky(plan, frame);
  return atmosphere_sky(frame, atmospheres);
}

}  // namespace skylapse::pipeline
