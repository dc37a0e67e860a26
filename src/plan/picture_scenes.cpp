#include "plan/picture_scenes.h"

#include <algorithm>
#include <cmath>

#include "plan/plan.h"

namespace skylapse::plan {
namespace {

/// Elevation of the top of the air for a camera above it; else the zenith.
Angle highest_air(Length height, const sky::atmosphere::AirDescription& air) {
  if (height <= air.top_height) return 90 * deg;
  return -std::acos((air.planet_radius + air.top_height) / (air.planet_radius + height)) * rad;
}

Frame frame_of(const ScheduledTime& time, int turbidity, int albedo) {
  Frame frame;
  frame.site = time.site;
  frame.instant = time.instant;
  frame.turbidity = turbidity, frame.albedo = albedo;
  return frame;
}

/// A map of all directions.
const CameraSky& whole_sky() {
  static const CameraSky sky = [] {
    image::Camera map;
    map.projection = image::Projection::lat_long;
    map.width = 720, map.height = 360;
    return CameraSky(map);
  }();
  return sky;
}

/// The scene as one camera sees it.
PictureScene scene_of(const PromiseInputs& in, const Picture& picture, const CameraSky& camera) {
  const ScheduledTime& time = in.schedule.times[picture.time];
  const auto air = air_of_frame(in.job, in.air, frame_of(time, picture.turbidity, picture.albedo));
  const Direction<Enu>& sun = in.suns[picture.time].sun_apparent;
  const Length height = camera_height(in.job.sites[time.site]);
  const Angle horizon = horizon_elevation(height, air.planet_radius);
  PictureScene scene;
  scene.features = {elevation(sun),
                    -horizon,
                    height,
                    air.aerosol_optical_depth,
                    in.job.air.ground_albedo[picture.albedo].value.value,
                    air.ozone_du};
  scene.shares = camera.shares(sun, horizon, highest_air(height, air));
  // A picture of the ground alone: what lights it is the sky, so the whole of that is promised.
  if (std::ranges::all_of(scene.shares, [](double share) { return share == 0; }))
    scene.shares = whole_sky().shares(sun, horizon, highest_air(height, air));
  scene.known_air = is_known_air(air);
  return scene;
}

}  // namespace

bool is_known_air(const sky::atmosphere::AirDescription& air) {
  const sky::atmosphere::AirDescription usual;
  const auto within = [](double value, double low, double high) {
    return value >= low && value <= high;
  };
  return air.stratospheric_optical_depth == 0 && within(air.aerosol_g, 0.55, 0.85) &&
         within(air.aerosol_single_scattering_albedo, 0.8, 1) &&
         within(air.angstrom_exponent, 0.3, 2) &&
         within(air.aerosol_scale_height / usual.aerosol_scale_height, 0.8, 1.7) &&
         within(air.surface_pressure / usual.surface_pressure, 0.9, 1.1) &&
         air.planet_radius == usual.planet_radius && air.top_height == usual.top_height;
}

std::vector<Picture> picture_scenes(const PromiseInputs& in) {
  struct View {
    int camera;
    CameraSky sky;
  };
  std::vector<View> views;  // each camera has as many: those of its own and of the outputs
  for (size_t c = 0; c < in.job.cameras.size(); ++c)
    for (const image::Camera& sky : sight_of(in.job, in.job.cameras[c]).skies())
      views.push_back({int(c), CameraSky(sky)});
  const size_t kinds = in.job.air.turbidity.size() * in.job.air.ground_albedo.size() * views.size();
  const size_t every = 1 + in.schedule.times.size() * kinds / kPicturesLookedAt;
  std::vector<Picture> pictures;
  for (size_t time = 0; time < in.schedule.times.size(); time += every)
    for (size_t t = 0; t < in.job.air.turbidity.size(); ++t)
      for (size_t a = 0; a < in.job.air.ground_albedo.size(); ++a)
        for (const View& view : views) {
          Picture picture{time, int(t), int(a), view.camera, {}};
          picture.scene = scene_of(in, picture, view.sky);
          pictures.push_back(picture);
        }
  return pictures;
}

}  // namespace skylapse::plan
