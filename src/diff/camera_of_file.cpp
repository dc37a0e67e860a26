#include "diff/camera_of_file.h"

#include <algorithm>
#include <string_view>

#include "image/camera/camera_check.h"
#include "image/camera/camera_words.h"
#include "image/camera/cube.h"
#include "image/orientation.h"

namespace skylapse::diff {
namespace {

using image::Camera;
using image::CubeLayout;
using image::Projection;

/// The layout that a picture of this shape can have: no two fit one shape.
std::optional<CubeLayout> layout_of_shape(Camera camera) {
  for (const CubeLayout layout : {CubeLayout::horizontal_strip, CubeLayout::vertical_strip,
                                  CubeLayout::cross, CubeLayout::vertical_cross}) {
    camera.cube_layout = layout;
    if (!image::camera_problem(camera)) return layout;
  }
  return std::nullopt;
}

/// One face in a file of its own: a perspective picture of 90 degrees.
std::optional<Camera> face_camera(const ToldValues& told, Camera camera) {
  const auto face = image::cube_face_from_name(told.text("skylapse:cubeFace"));
  if (!face || camera.width != camera.height) return std::nullopt;
  const auto axes = image::cube_face_axes(CubeLayout::vertical_strip, *face);
  camera.projection = Projection::perspective;
  camera.field_of_view = 90 * deg;
  camera.camera_to_enu = camera.camera_to_enu * glm::dmat3(axes.right, axes.up, axes.forward);
  return camera;
}

std::optional<Camera> cube_camera(const ToldValues& told, Camera camera) {
  const std::string word = told.text("skylapse:cubeLayout", "/camera/layout");
  if (word == image::kFacesApart) return face_camera(told, camera);
  const auto layout = word.empty() ? layout_of_shape(camera) : image::cube_layout_from_name(word);
  if (!layout) return std::nullopt;
  const bool strip =
      *layout == CubeLayout::horizontal_strip || *layout == CubeLayout::vertical_strip;
  const auto orientation =
      image::orientation_from_name(told.text("skylapse:orientation", "/output/orientation"));
  const bool opengl =
      orientation && image::convention_of(*orientation).cube_order == image::CubeOrder::opengl;
  if (strip && opengl) return std::nullopt;
  camera.cube_layout = *layout;
  return camera;
}

std::optional<Camera> upright_camera(const ToldValues& told, Camera camera) {
  auto heading = told.number("skylapse:heading", "/camera/azimuth_deg");
  const bool ours = !told.text("skylapse:projection", "/camera/projection").empty();
  if (!heading && ours) return std::nullopt;
  camera.camera_to_enu = image::look_at(heading.value_or(0) * deg, Angle{}, Angle{});
  if (camera.projection == Projection::cube) return cube_camera(told, camera);
  const bool mirrored = told.text("skylapse:orientation", "/output/orientation") == "pbrt";
  if (camera.projection == Projection::lat_long && mirrored) return std::nullopt;
  return camera;
}

std::optional<Camera> turned_camera(const ToldValues& told, Camera camera) {
  const auto azimuth = told.number("skylapse:lookAzimuth", "/camera/azimuth_deg");
  const auto elevation = told.number("skylapse:lookElevation", "/camera/elevation_deg");
  const auto roll = told.number("skylapse:roll", "/camera/roll_deg");
  const auto view = told.number("skylapse:fieldOfView", "/camera/field_of_view_deg");
  const bool whole = camera.projection == Projection::mirror_ball;
  if (!azimuth || !elevation || !roll || (!view && !whole)) return std::nullopt;
  camera.camera_to_enu = image::look_at(*azimuth * deg, *elevation * deg, *roll * deg);
  if (view) camera.field_of_view = *view * deg;
  return camera;
}

}  // namespace

std::string projection_of_file(const ToldValues& told) {
  const std::string word = told.text("skylapse:projection", "/camera/projection");
  if (!word.empty()) return word;
  // OpenImageIO's name of OpenEXR's envmap.
  const std::string format = told.text("textureformat");
  if (format == "LatLong Environment") return "lat-long";
  return format == "CubeFace Environment" ? "cube" : "";
}

std::optional<Camera> camera_of_file(const ToldValues& told, int width, int height) {
  const auto projection = image::projection_from_name(projection_of_file(told));
  if (!projection) return std::nullopt;
  Camera camera{.projection = *projection, .width = width, .height = height};
  const auto made = image::stands_upright(*projection) ? upright_camera(told, camera)
                                                       : turned_camera(told, camera);
  return made && !image::camera_problem(*made) ? made : std::nullopt;
}

}  // namespace skylapse::diff
