#include "image/camera/chart.h"

#include <algorithm>

#include "image/camera/fisheye.h"
#include "image/camera/lat_long.h"
#include "image/camera/perspective.h"

namespace skylapse::image {
namespace {

constexpr double kPi = std::numbers::pi;

bool is_fisheye(const Camera& camera) {
  return camera.projection == Projection::mirror_ball ||
         camera.projection == Projection::fisheye_equidistant ||
         camera.projection == Projection::fisheye_equisolid ||
         camera.projection == Projection::fisheye_stereographic;
}

/// Of the plane at `distance_px`, where the ray makes the angle with cosine `c` with the axis.
double plane_density(double distance_px, double c) {
  return c * c * c / (distance_px * distance_px);
}

PixelExtent fisheye_extent(const Camera& camera, const Direction<CameraFrame>& centre,
                           Angle radius) {
  const double half_pixel = 0.5 / fisheye_circle(camera).radius_px;
  const Angle theta = separation(centre, fisheye_axis(camera));
  const Angle edge = std::min(theta, fisheye_theta_max(camera));
  const double r = std::max(half_pixel, fisheye_r(camera, edge) - half_pixel);
  const Angle inner = fisheye_theta(camera, r - half_pixel).value_or(Angle{});
  const Angle outer = fisheye_theta(camera, r + half_pixel).value_or(kPi * rad);
  const Angle radial = outer - inner;
  // Straight behind, the disc is a ring along the rim of a full sphere: half a radius from there.
  const double sine = std::max(sin(edge), edge > 90 * deg ? sin(0.5 * radius) : 0.0);
  const Angle tangential = (edge > Angle{} ? sine * 2 * half_pixel / r : radial.in(rad)) * rad;
  const Angle extent = std::max(radial, tangential);
  return {extent, extent, radial.in(rad)*tangential.in(rad)*sr};
}

PixelExtent lat_long_extent(const Camera& camera, const Direction<CameraFrame>& centre,
                            Angle radius) {
  // The widest part of the disc is the one farthest from the pole.
  const double from_equator = std::abs(std::atan2(centre.y(), std::hypot(centre.x(), centre.z())));
  const double lowest = std::max(0.0, from_equator - radius.in(rad));
  const double x = 2 * kPi / camera.width * std::cos(lowest), y = kPi / camera.height;
  return {x * rad, y * rad, x * y * sr};
}

/// Of the plane at `focal_px`, seen along the unit vector d = (right, up, axis): a step dX at
/// (X, Y) = (d.x, d.y) / d.z turns the ray by dX sqrt(1 + Y^2) / (1 + X^2 + Y^2).
PixelExtent plane_extent(double focal_px, const glm::dvec3& d) {
  return {d.z * std::hypot(d.z, d.y) / focal_px * rad, d.z * std::hypot(d.z, d.x) / focal_px * rad,
          plane_density(focal_px, d.z) * sr};
}

PixelExtent cube_extent(const Camera& camera, const Direction<CameraFrame>& centre) {
  const auto position = cube_position(camera, centre);
  const auto axes = cube_face_axes(camera.cube_layout, *cube_face_at(camera, position));
  return plane_extent(0.5 * cube_face_size(camera),
                      {glm::dot(centre.vec(), axes.right), glm::dot(centre.vec(), axes.up),
                       glm::dot(centre.vec(), axes.forward)});
}

PixelExtent perspective_extent(const Camera& camera, const Direction<CameraFrame>& centre) {
  // Outside the picture its nearest edge counts: the plane's far reaches may lie behind.
  const double f = perspective_focal_length_px(camera);
  const auto p = perspective_position(camera, centre);
  const double half_w = 0.5 * camera.width, half_h = 0.5 * camera.height;
  const double x = p ? p->x - half_w : std::copysign(half_w, centre.x());
  const double y = p ? half_h - p->y : std::copysign(half_h, centre.y());
  return plane_extent(f, glm::normalize(glm::dvec3{std::clamp(x, -half_w, half_w),
                                                   std::clamp(y, -half_h, half_h), f}));
}

}  // namespace

std::vector<Chart> charts(const Camera& camera) {
  std::vector<Chart> pieces;
  if (camera.projection == Projection::cube) {
    for (const CubeFace face : kCubeFaces) pieces.push_back({camera, face});
  } else if (camera.projection == Projection::octahedral) {
    for (const int up : {1, -1})
      for (const int v : {1, -1})
        for (const int u : {1, -1}) pieces.push_back({camera, {}, Octant{u, v, up}});
  } else {
    pieces.push_back({camera});
  }
  return pieces;
}

std::optional<ChartSample> chart_sample(const Chart& chart, PixelPosition position) {
  const Camera& camera = chart.camera;
  if (camera.projection == Projection::perspective) {
    const auto d = perspective_ray(camera, position);
    return ChartSample{d, plane_density(perspective_focal_length_px(camera), d.z())};
  }
  if (camera.projection == Projection::cube) {
    const auto d = cube_ray(camera, *chart.face, position);
    const auto axes = cube_face_axes(camera.cube_layout, *chart.face);
    return ChartSample{
        d, plane_density(0.5 * cube_face_size(camera), glm::dot(axes.forward, d.vec()))};
  }
  if (camera.projection == Projection::lat_long) {
    const double row = kPi / camera.height, column = 2 * kPi / camera.width;
    return ChartSample{lat_long_ray(camera, position),
                       std::abs(std::sin(position.y * row)) * row * column};
  }
  if (camera.projection == Projection::octahedral)
    return ChartSample{octant_ray(camera, *chart.octant, position),
                       octahedral_solid_angle_sr(camera)};
  const auto d = fisheye_ray(camera, position);
  if (!d) return {};
  return ChartSample{*d, fisheye_sr_per_pixel(camera, position)};
}

double share_in_picture(const Chart& chart, PixelPosition position, const ChartSample& sample,
                        SolidAngle cell) {
  const Camera& camera = chart.camera;
  if (is_fisheye(camera)) {
    const Angle half = fisheye_theta_max(camera);
    if (half >= kPi * rad) return 1;  // the whole sphere: nothing lies outside
    return horizon_coverage(half - separation(sample.direction, fisheye_axis(camera)), cell);
  }
  if (camera.projection == Projection::cube)
    return cube_face_at(camera, position) == chart.face ? 1 : 0;
  if (camera.projection == Projection::octahedral)
    return octant_at(camera, position) == chart.octant ? 1 : 0;
  if (camera.projection == Projection::lat_long)
    return position.y >= 0 && position.y <= camera.height ? 1 : 0;
  return position.x >= 0 && position.x <= camera.width && position.y >= 0 &&
                 position.y <= camera.height
             ? 1
             : 0;
}

bool fills_pixel(const Chart& chart, int x, int y) {
  const Camera& camera = chart.camera;
  if (stands_upright(camera.projection)) return true;  // lat-long, cube, octahedral
  return direction_at(camera, {x + 0.5, y + 0.5}).has_value();
}

PixelExtent pixel_extent(const Camera& camera, const Direction<CameraFrame>& centre, Angle radius) {
  if (camera.projection == Projection::lat_long) return lat_long_extent(camera, centre, radius);
  if (camera.projection == Projection::cube) return cube_extent(camera, centre);
  if (camera.projection == Projection::perspective) return perspective_extent(camera, centre);
  if (camera.projection == Projection::octahedral) {
    const Angle side = octahedral_pixel_extent(camera, centre, radius);
    return {side, side, octahedral_solid_angle_sr(camera) * sr};
  }
  return fisheye_extent(camera, centre, radius);
}

}  // namespace skylapse::image
