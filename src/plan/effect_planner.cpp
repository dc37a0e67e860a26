#include "plan/effect_planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skylapse::plan {
namespace {

EffectDecision decide_sun_disc(const config::JobConfig& job, const Frame& frame) {
  const Angle upper_limb = elevation(frame.sky.sun_apparent) + frame.sky.sun_radius - frame.horizon;
  if (!job.sky.sun_disc)
    return {Effect::sun_disc, false, "switched off by sky.sun_disc", std::nullopt};
  if (upper_limb <= 0 * deg)
    return {Effect::sun_disc, false,
            fmt::format("the disc is below the horizon (upper limb at {:.2f} deg)",
                        upper_limb.in(deg))};
  if (!sun_disc_in_view(job.cameras[frame.camera].camera, frame.sky, frame.horizon))
    return {Effect::sun_disc, false, "the sun is outside the picture"};
  return {Effect::sun_disc, true, "the sun is in the picture"};
}

EffectDecision decide_ground(const config::JobConfig& job, const Frame& frame) {
  if (!ground_in_view(job.cameras[frame.camera].camera, frame.horizon))
    return {Effect::ground, false, "no pixel looks below the horizon"};
  return {Effect::ground, true, "the picture reaches below the horizon"};
}

EffectDecision decide_refraction(const config::JobConfig& job, const Frame& frame) {
  const Angle shift = separation(frame.sky.sun_true, frame.sky.sun_apparent);
  if (!job.air.refraction.enabled)
    return {Effect::refraction, false, "switched off by air.refraction", std::nullopt};
  return {Effect::refraction, true,
          fmt::format("lifts the sun by {:.2f} arcmin", shift.in(arcmin))};
}

EffectDecision decide_twilight(const Frame& frame) {
  if (!frame.sun.extrapolated)
    return {Effect::twilight_continuation, false, "the sun is above the horizon"};
  return {Effect::twilight_continuation, true,
          fmt::format("the model ends at the horizon: shape held, level {:.3g}",
                      frame.sun.twilight_level)};
}

EffectDecision decide_multiple_scattering(const Plan& plan) {
  if (plan.model == config::SkyModel::single_scattering)
    return {Effect::multiple_scattering, false, "left out by sky.model: single-scattering",
            std::nullopt};
  return {Effect::multiple_scattering, true,
          "all orders, level " + sky::bruneton::name_of(plan.job.sky.level)};
}

/// Directions on the circle of radius `r` around the sun, and its centre.
std::vector<Direction<Enu>> limb_points(const Direction<Enu>& sun, Angle r) {
  const glm::dvec3 side = glm::normalize(
      glm::cross(sun.vec(), std::abs(sun.z()) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
  const glm::dvec3 up = glm::cross(side, sun.vec());
  std::vector<Direction<Enu>> points{sun};
  for (int i = 0; i < 16; ++i) {
    const Angle a = i * 22.5 * deg;
    points.push_back(
        Direction<Enu>::from_vector(sun.vec() * cos(r) + (side * cos(a) + up * sin(a)) * sin(r)));
  }
  return points;
}

/// Points along the edge of what the camera sees: the image's sides, or the fisheye circle.
std::vector<image::PixelPosition> outline(const image::Camera& camera) {
  constexpr int kPoints = 64;
  const double w = camera.width, h = camera.height;
  std::vector<image::PixelPosition> points;
  for (int i = 0; i <= kPoints; ++i) {
    const double t = double(i) / kPoints;
    if (camera.projection == image::Projection::perspective) {
      points.insert(points.end(), {{t * w, h}, {t * w, 0}, {0, t * h}, {w, t * h}});
    } else {
      const double radius = 0.4999 * std::min(w, h);
      const Angle a = t * 360 * deg;
      points.push_back({0.5 * w + radius * sin(a), 0.5 * h + radius * cos(a)});
    }
  }
  return points;
}

}  // namespace

bool sun_disc_in_view(const image::Camera& camera, const astro::SkyState& sky, Angle horizon) {
  if (elevation(sky.sun_apparent) + sky.sun_radius <= horizon) return false;
  // A disc smaller than a pixel spreads over its neighbours: look one pixel further out.
  const SolidAngle pixel = image::pixel_solid_angle(camera, camera.width / 2, camera.height / 2);
  const Angle reach = sky.sun_radius + 1.5 * std::sqrt(pixel.in(sr)) * rad;
  for (const auto& point : limb_points(sky.sun_apparent, reach))
    if (image::position_of(camera, point)) return true;
  return false;
}

bool ground_in_view(const image::Camera& camera, Angle horizon) {
  if (camera.projection == image::Projection::lat_long ||
      camera.projection == image::Projection::cube)
    return true;
  // Elevation has no minimum on the sphere but the nadir: look there and along the outline.
  if (image::position_of(camera, enu_direction(0 * deg, -90 * deg))) return true;
  for (const image::PixelPosition& position : outline(camera)) {
    const auto d = image::direction_at(camera, position);
    if (d && d->z() < sin(horizon)) return true;
  }
  return false;
}

std::vector<EffectDecision> decide_effects(const Plan& plan, const Frame& frame) {
  const config::JobConfig& job = plan.job;
  return {decide_sun_disc(job, frame), decide_ground(job, frame), decide_refraction(job, frame),
          is_fitted(plan.model) ? decide_twilight(frame) : decide_multiple_scattering(plan)};
}

}  // namespace skylapse::plan
