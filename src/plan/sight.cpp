#include "plan/sight.h"

#include <algorithm>

namespace skylapse::plan {
namespace {

bool same_view(const image::Camera& a, const image::Camera& b) {
  return a.projection == b.projection && a.width == b.width && a.height == b.height &&
         a.field_of_view == b.field_of_view && a.cube_layout == b.cube_layout &&
         a.camera_to_enu == b.camera_to_enu;
}

void add(const image::Camera& camera, std::vector<image::Camera>& pictures) {
  if (std::none_of(pictures.begin(), pictures.end(),
                   [&](const image::Camera& other) { return same_view(camera, other); }))
    pictures.push_back(camera);
}

bool shows_camera(const config::Output& output) {
  if (const auto* image = std::get_if<config::ImageOutput>(&output)) return !image->own_view;
  return std::holds_alternative<config::MovieOutput>(output);
}

bool gathers_light(const config::Output& output) {
  const auto* product = std::get_if<config::ProductOutput>(&output);
  return product != nullptr && (product->kind == config::ProductKind::specular ||
                                product->kind == config::ProductKind::irradiance ||
                                product->kind == config::ProductKind::harmonics);
}

/// A map of all directions, for those that have no picture.
image::Camera whole_sky() {
  image::Camera map;
  map.projection = image::Projection::lat_long;
  map.width = 720, map.height = 360;
  return map;
}

}  // namespace

Sight sight_of(const config::JobConfig& job, const config::CameraConfig& camera) {
  Sight sight;
  const auto& outputs = job.outputs;
  if (std::any_of(outputs.begin(), outputs.end(), shows_camera))
    sight.pictures.push_back(camera.camera);
  for (const config::Output& output : outputs)
    if (const auto* image = std::get_if<config::ImageOutput>(&output); image && image->own_view)
      add(image->own_view->camera, sight.pictures);
  sight.all_directions = std::any_of(outputs.begin(), outputs.end(), gathers_light);
  // A job of lights alone has no picture: what its camera would see decides.
  if (sight.pictures.empty()) sight.pictures.push_back(camera.camera);
  return sight;
}

ViewReach Sight::reach() const {
  if (all_directions) return {};
  ViewReach all{90 * deg, -90 * deg};
  for (const image::Camera& picture : pictures) {
    const ViewReach one = view_reach(picture);
    all.lowest = std::min(all.lowest, one.lowest);
    all.highest = std::max(all.highest, one.highest);
  }
  return all;
}

PixelSides Sight::pixels() const {
  PixelSides all = pixel_sides(pictures.front());
  for (size_t i = 1; i < pictures.size(); ++i) {
    const PixelSides one = pixel_sides(pictures[i]);
    all.smallest = std::min(all.smallest, one.smallest);
    all.largest = std::max(all.largest, one.largest);
  }
  return all;
}

bool Sight::sees_disc(const Direction<Enu>& centre, Angle reach, double margin) const {
  return all_directions ||
         std::any_of(pictures.begin(), pictures.end(), [&](const image::Camera& picture) {
           return disc_in_picture(picture, centre, reach + margin * pixel_sides(picture).largest);
         });
}

std::vector<image::Camera> Sight::skies() const {
  std::vector<image::Camera> skies;
  bool whole = false;
  for (const image::Camera& picture : pictures) {
    const bool sees_all = image::sees_whole_sphere(picture.projection);
    if (!sees_all || !whole) skies.push_back(picture);
    whole |= sees_all;
  }
  if (all_directions && !whole) skies.push_back(whole_sky());
  return skies;
}

const image::Camera* Sight::only_picture() const {
  return pictures.size() == 1 && !all_directions ? &pictures.front() : nullptr;
}

}  // namespace skylapse::plan
