#include "image/camera/fisheye.h"

#include <algorithm>
#include <array>
#include <limits>

namespace skylapse::image {
namespace {

constexpr double kPi = std::numbers::pi;

double half_fov_rad(const Camera& camera) { return fisheye_theta_max(camera).in(rad); }

/// Of the camera's forward axis along the lens's own.
double axis_sign(const Camera& camera) {
  return camera.projection == Projection::mirror_ball ? -1 : 1;
}

/// cos(theta) and sin(theta) / r at r: trigonometry only where the lens itself has it.
struct LensAngle {
  double cos_theta;
  double sin_theta_over_r;
};

std::optional<LensAngle> lens_angle(const Camera& camera, double r) {
  const double m = half_fov_rad(camera);
  switch (camera.projection) {
    case Projection::mirror_ball:
    case Projection::fisheye_equisolid: {
      const double s = std::sin(0.5 * m);
      const double s2 = s * s * r * r;
      if (!(s2 <= 1)) return {};
      return LensAngle{1 - 2 * s2, 2 * s * std::sqrt(1 - s2)};
    }
    case Projection::fisheye_stereographic: {
      const double t = std::tan(0.5 * m);
      const double t2 = t * t * r * r;
      return LensAngle{(1 - t2) / (1 + t2), 2 * t / (1 + t2)};
    }
    default: {
      if (!(r * m <= kPi)) return {};
      return LensAngle{std::cos(r * m), r > 0 ? std::sin(r * m) / r : m};
    }
  }
}

/// Solid angle per area of the image at r^2, the circle's radius being 1:
/// (sin(theta) / r) d theta / d r. Zero where the formula has left the sphere.
double density(const Camera& camera, double r2) {
  const double m = half_fov_rad(camera);
  switch (camera.projection) {
    case Projection::mirror_ball:
    case Projection::fisheye_equisolid: {
      const double s2 = std::sin(0.5 * m) * std::sin(0.5 * m);
      return s2 * r2 <= 1 ? 4 * s2 : 0;
    }
    case Projection::fisheye_stereographic: {
      const double t2 = std::tan(0.5 * m) * std::tan(0.5 * m);
      return 4 * t2 / ((1 + t2 * r2) * (1 + t2 * r2));
    }
    default: {
      const double r = std::sqrt(r2);
      if (r * m > kPi) return 0;
      return r > 0 ? m * std::sin(r * m) / r : m * m;
    }
  }
}

/// Gauss-Legendre nodes on a pixel's side, cut into so many steps that the density is smooth over
/// each. The angle a pixel spans decides: below 0.1 rad two nodes err by less than 1e-7.
struct PixelQuadrature {
  int steps;
  int nodes;  // per step: 2 or 3
};

PixelQuadrature pixel_quadrature(const Camera& camera, double side) {
  const bool stereographic = camera.projection == Projection::fisheye_stereographic;
  const double m = half_fov_rad(camera);
  const double span = (stereographic ? 2 * std::tan(0.5 * m) : m) * side;
  return {static_cast<int>(std::clamp(std::ceil(span / 0.25), 1.0, 64.0)), span < 0.1 ? 2 : 3};
}

struct GaussRule {
  std::array<double, 3> nodes, weights;  // on [0, 1]
};
const GaussRule kTwoNodes{{0.21132486540518711775, 0.78867513459481288225, 0}, {0.5, 0.5, 0}};
const GaussRule kThreeNodes{{0.11270166537925831148, 0.5, 0.88729833462074168852},
                            {5.0 / 18, 8.0 / 18, 5.0 / 18}};

}  // namespace

FisheyeCircle fisheye_circle(const Camera& camera) {
  return {0.5 * camera.width, 0.5 * camera.height, 0.5 * std::min(camera.width, camera.height)};
}

Direction<CameraFrame> fisheye_axis(const Camera& camera) {
  return Direction<CameraFrame>::from_vector({0, 0, axis_sign(camera)});
}

Angle fisheye_theta_max(const Camera& camera) {
  return camera.projection == Projection::mirror_ball ? kPi * rad : 0.5 * camera.field_of_view;
}

double fisheye_radius_at(const Camera& camera, PixelPosition position) {
  const auto [cx, cy, radius] = fisheye_circle(camera);
  return std::hypot(position.x - cx, position.y - cy) / radius;
}

std::optional<Angle> fisheye_theta(const Camera& camera, double r) {
  const auto lens = lens_angle(camera, r);
  if (!lens) return {};
  return atan2_angle(lens->sin_theta_over_r * r, lens->cos_theta);
}

double fisheye_r(const Camera& camera, Angle theta) {
  const double m = half_fov_rad(camera), t = theta.in(rad);
  switch (camera.projection) {
    case Projection::mirror_ball:
    case Projection::fisheye_equisolid:
      return std::sin(0.5 * t) / std::sin(0.5 * m);
    case Projection::fisheye_stereographic:
      return t < kPi ? std::tan(0.5 * t) / std::tan(0.5 * m)
                     : std::numeric_limits<double>::infinity();
    default:
      return t / m;
  }
}

std::optional<Direction<CameraFrame>> fisheye_ray(const Camera& camera, PixelPosition position) {
  const auto [cx, cy, radius] = fisheye_circle(camera);
  const double x = (position.x - cx) / radius, y = (cy - position.y) / radius;
  const auto lens = lens_angle(camera, std::hypot(x, y));
  if (!lens) return {};
  const double k = lens->sin_theta_over_r;
  return Direction<CameraFrame>::from_vector({k * x, k * y, axis_sign(camera) * lens->cos_theta});
}

std::optional<PixelPosition> fisheye_position(const Camera& camera,
                                              const Direction<CameraFrame>& direction) {
  const auto [cx, cy, radius] = fisheye_circle(camera);
  const double sin_theta = std::hypot(direction.x(), direction.y());
  const double r = fisheye_r(camera, atan2_angle(sin_theta, axis_sign(camera) * direction.z()));
  if (!std::isfinite(r)) return {};
  if (sin_theta == 0) return PixelPosition{cx + radius * r, cy};  // r = 0, or straight behind
  return PixelPosition{cx + radius * r * (direction.x() / sin_theta),
                       cy - radius * r * (direction.y() / sin_theta)};
}

double fisheye_sr_per_pixel(const Camera& camera, PixelPosition position) {
  const double r = fisheye_radius_at(camera, position);
  const double radius = fisheye_circle(camera).radius_px;
  return density(camera, r * r) / (radius * radius);
}

double fisheye_solid_angle_sr(const Camera& camera, int x, int y) {
  const auto [cx, cy, radius] = fisheye_circle(camera);
  const double side = 1 / radius;
  const auto [steps, n] = pixel_quadrature(camera, side);
  const GaussRule& rule = n == 2 ? kTwoNodes : kThreeNodes;
  double sum = 0;
  for (int i = 0; i < n * steps; ++i) {
    const double v = (y - cy + (i / n + rule.nodes[i % n]) / steps) * side;
    for (int j = 0; j < n * steps; ++j) {
      const double u = (x - cx + (j / n + rule.nodes[j % n]) / steps) * side;
      sum += rule.weights[i % n] * rule.weights[j % n] * density(camera, u * u + v * v);
    }
  }
  return sum * side * side / (double(steps) * steps);
}

}  // namespace skylapse::image
