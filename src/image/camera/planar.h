#pragma once
// The plane at unit distance before an eye: what a perspective image and a cube face share.

namespace skylapse::image {

/// A rectangle of the plane z = 1, in multiples of the distance.
struct PlaneRectangle {
  double x0, x1;  // x0 < x1
  double y0, y1;  // y0 < y1
};

/// Solid angle of the rectangle seen from the origin, in steradians; relative error below 1e-8.
/// Large rectangles: closed form, sum of +-atan(xy / sqrt(1 + x^2 + y^2)) over the corners. Small
/// ones, where that sum cancels: Gauss quadrature of (1 + x^2 + y^2)^(-3/2).
double solid_angle_sr(const PlaneRectangle& r);

}  // namespace skylapse::image
