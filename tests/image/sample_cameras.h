#pragma once
// Cameras of every kind, for laws that hold for all of them.
#include <ostream>
#include <string>
#include <vector>

#include "image/camera/camera.h"

namespace skylapse::image {

struct NamedCamera {
  std::string name;
  Camera camera;
};
inline std::ostream& operator<<(std::ostream& out, const NamedCamera& c) { return out << c.name; }

inline Camera make_camera(Projection projection, int width, int height, Angle fov,
                          const glm::dmat3& axes = look_at({}, {}, {}),
                          CubeLayout layout = CubeLayout::vertical_strip) {
  return {projection, width, height, fov, layout, axes};
}

/// All-sky fisheye looking at the zenith, north at the upper edge.
inline Camera zenith_fisheye(Projection projection, int size, Angle fov = 180 * deg) {
  return make_camera(projection, size, size, fov, look_at(180 * deg, 90 * deg, {}));
}

inline std::vector<NamedCamera> sample_cameras() {
  using enum Projection;
  const glm::dmat3 tilted = look_at(217 * deg, 23 * deg, -11 * deg);
  const glm::dmat3 heading = look_at(75 * deg, {}, {});
  return {
      {"perspective", make_camera(perspective, 192, 108, 75 * deg)},
      {"perspective_wide_tilted", make_camera(perspective, 90, 120, 150 * deg, tilted)},
      {"perspective_up", make_camera(perspective, 64, 64, 90 * deg, look_at({}, 90 * deg, {}))},
      {"perspective_narrow", make_camera(perspective, 64, 48, 0.5 * deg, tilted)},
      {"equidistant_zenith", zenith_fisheye(fisheye_equidistant, 128)},
      {"equidistant_full", make_camera(fisheye_equidistant, 128, 128, 360 * deg, tilted)},
      {"equisolid_zenith", zenith_fisheye(fisheye_equisolid, 128)},
      {"equisolid_full", make_camera(fisheye_equisolid, 160, 128, 360 * deg, tilted)},
      {"stereographic_zenith", zenith_fisheye(fisheye_stereographic, 128)},
      {"stereographic_wide", make_camera(fisheye_stereographic, 128, 160, 300 * deg, tilted)},
      {"lat_long", make_camera(lat_long, 128, 64, {})},
      {"lat_long_heading", make_camera(lat_long, 90, 60, {}, heading)},
      {"cube_vertical", make_camera(cube, 32, 192, {})},
      {"cube_horizontal", make_camera(cube, 198, 33, {}, heading, CubeLayout::horizontal_strip)},
      {"cube_cross", make_camera(cube, 128, 96, {}, heading, CubeLayout::cross)},
      {"cube_vertical_cross", make_camera(cube, 96, 128, {}, heading, CubeLayout::vertical_cross)},
      {"octahedral", make_camera(octahedral, 96, 96, {})},
      {"octahedral_odd_heading", make_camera(octahedral, 75, 75, {}, heading)},
      {"mirror_ball", make_camera(mirror_ball, 128, 128, {})},
      {"mirror_ball_tilted", make_camera(mirror_ball, 160, 128, 90 * deg, tilted)},
  };
}

}  // namespace skylapse::image
