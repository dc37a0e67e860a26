#include "image/camera/camera_check.h"

#include <fmt/format.h>

namespace skylapse::image {
namespace {

using Problem = std::optional<std::string>;

Problem size_problem(const Camera& c) {
  const auto allowed = [](int side) { return side >= 1 && side <= kMaxImageSide; };
  if (allowed(c.width) && allowed(c.height)) return {};
  return fmt::format("image size {}x{} is out of range (allowed: 1 to {} pixels each way)", c.width,
                     c.height, kMaxImageSide);
}

Problem cube_problem(const Camera& c) {
  const int64_t w = c.width, h = c.height;
  const auto message = [&](const char* layout, const char* shape, int64_t n, int64_t nw,
                           int64_t nh) {
    return fmt::format("size {}x{} does not fit a cube as {} (allowed: {}, for instance {}x{})", w,
                       h, layout, shape, n * nw, n * nh);
  };
  switch (c.cube_layout) {
    case CubeLayout::horizontal_strip:
      if (w != 6 * h)
        return message("a horizontal strip", "6n x n", std::max<int64_t>(1, w / 6), 6, 1);
      break;
    case CubeLayout::vertical_strip:
      if (h != 6 * w)
        return message("a vertical strip", "n x 6n", std::max<int64_t>(1, h / 6), 1, 6);
      break;
    case CubeLayout::cross:
      if (w * 3 != h * 4 || h % 3 != 0)
        return message("a cross", "4n x 3n", std::max<int64_t>(1, w / 4), 4, 3);
      break;
    case CubeLayout::vertical_cross:
      if (w * 4 != h * 3 || w % 3 != 0)
        return message("a vertical cross", "3n x 4n", std::max<int64_t>(1, w / 3), 3, 4);
      break;
  }
  return {};
}

Problem octahedral_problem(const Camera& c) {
  if (c.width == c.height) return {};
  return fmt::format("size {}x{} is no octahedral map (allowed: a square, for instance {}x{})",
                     c.width, c.height, c.width, c.width);
}

Problem field_of_view_problem(const Camera& c) {
  const double fov = c.field_of_view.in(deg);
  const auto message = [&](const char* kind, const char* range) {
    return fmt::format("field of view {:g} deg is out of range for {} (allowed: {})", fov, kind,
                       range);
  };
  switch (c.projection) {
    case Projection::perspective:
      if (!(fov > 0 && fov < 180))
        return message("a perspective camera", "above 0 and below 180 deg");
      break;
    case Projection::fisheye_equidistant:
    case Projection::fisheye_equisolid:
      if (!(fov > 0 && fov <= 360)) return message("a fisheye", "above 0 deg, up to 360 deg");
      break;
    case Projection::fisheye_stereographic:
      if (!(fov > 0 && fov < 360))
        return message("a stereographic fisheye", "above 0 and below 360 deg");
      break;
    case Projection::lat_long:
    case Projection::cube:
    case Projection::octahedral:
    case Projection::mirror_ball:
      break;  // the whole sphere
  }
  return {};
}

Problem orientation_problem(const Camera& c) {
  constexpr double kTolerance = 1e-9;
  const glm::dmat3 gram = glm::transpose(c.camera_to_enu) * c.camera_to_enu;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (!(std::abs(gram[i][j] - (i == j ? 1 : 0)) < kTolerance))
        return "the camera's axes are not unit vectors at right angles";
  if (glm::determinant(c.camera_to_enu) > 0)
    return "the camera's axes show a mirror image (right x up must point backward)";
  const bool upright = c.camera_to_enu[1].z > 1 - kTolerance;
  if (stands_upright(c.projection) && !upright)
    return "lat-long, cube and octahedral images stand upright: only their heading (azimuth) can "
           "be "
           "turned";
  return {};
}

}  // namespace

std::optional<std::string> camera_problem(const Camera& camera) {
  if (auto p = size_problem(camera)) return p;
  if (camera.projection == Projection::cube)
    if (auto p = cube_problem(camera)) return p;
  if (camera.projection == Projection::octahedral)
    if (auto p = octahedral_problem(camera)) return p;
  if (auto p = field_of_view_problem(camera)) return p;
  return orientation_problem(camera);
}

}  // namespace skylapse::image
