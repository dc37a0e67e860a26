#pragma once
// Fisheye lenses and the mirror ball. r is the distance from the image centre over the radius of
// the image circle, theta the angle from the optical axis, theta_max = field of view / 2:
//   equidistant    theta = r theta_max
//   equisolid      sin(theta / 2) = r sin(theta_max / 2)     (equal area)
//   stereographic  tan(theta / 2) = r tan(theta_max / 2)     (conformal)
// Mirror ball: a perfect mirror sphere photographed from afar (orthographic) along the camera's
// forward axis, as by Debevec 1998, "Rendering Synthetic Objects into Real Scenes". Its normal at r
// leans asin(r) from the viewer, so it reflects theta = 2 asin(r) from the *backward* axis:
//   sin(theta / 2) = r: equisolid with theta_max = 180 deg about the axis that points back.
// The middle shows what is behind the camera, the rim what lies ahead, hidden by the ball: that one
// direction is singular. Right stays right and up stays up, so the picture is mirrored, as in any
// mirror: the one exception to docs/conventions.md. Every pixel has the same solid angle.
#include "image/camera/camera.h"

namespace skylapse::image {

/// The image circle: as wide as the image's shorter side, in the middle of the image.
struct FisheyeCircle {
  double centre_x_px, centre_y_px, radius_px;
};
FisheyeCircle fisheye_circle(const Camera& camera);

/// What the middle of the circle shows: forward, or of a mirror ball backward. theta counts from
/// it.
Direction<CameraFrame> fisheye_axis(const Camera& camera);
/// Half the field of view; 180 deg of a mirror ball.
Angle fisheye_theta_max(const Camera& camera);

/// Angle from the optical axis at r >= 0; nothing where the formula has left the sphere.
std::optional<Angle> fisheye_theta(const Camera& camera, double r);
/// Inverse of fisheye_theta, for theta in [0, 180] deg; infinite for stereographic at 180 deg.
double fisheye_r(const Camera& camera, Angle theta);

/// Direction of any position, outside the image circle too as far as the formula goes.
std::optional<Direction<CameraFrame>> fisheye_ray(const Camera& camera, PixelPosition position);

/// Where a direction falls, outside the image circle too. Opposite to the axis, where a whole
/// circle shows one direction, the point to the right is taken.
std::optional<PixelPosition> fisheye_position(const Camera& camera,
                                              const Direction<CameraFrame>& direction);

/// Solid angle of the whole pixel square, the picture's edge left aside.
double fisheye_solid_angle_sr(const Camera& camera, int x, int y);

/// Solid angle per area of the image at a position, a pixel's area being 1; 0 where the formula
/// has left the sphere.
double fisheye_sr_per_pixel(const Camera& camera, PixelPosition position);

/// Distance of a position from the image centre, in radii of the image circle.
double fisheye_radius_at(const Camera& camera, PixelPosition position);

}  // namespace skylapse::image
