#include "sky/facet.h"

#include <algorithm>
#include <cmath>

#include "image/camera/cube.h"
#include "image/camera/fisheye.h"
#include "image/camera/octahedral.h"
#include "image/camera/perspective.h"

namespace skylapse::sky {
namespace {

Facet whole_image(const image::Camera& camera) {
  Facet facet;
  facet.width = camera.width;
  facet.height = camera.height;
  facet.centre_x = 0.5 * camera.width;
  facet.centre_y = 0.5 * camera.height;
  facet.axes = camera.camera_to_enu;
  return facet;
}

Facet fisheye_facet(const image::Camera& camera) {
  Facet facet = whole_image(camera);
  facet.unit_px = image::fisheye_circle(camera).radius_px;
  const Angle quarter_fov = 0.5 * image::fisheye_theta_max(camera);
  facet.axes[2] *= image::fisheye_axis(camera).z();
  switch (camera.projection) {
    case image::Projection::mirror_ball:
    case image::Projection::fisheye_equisolid:
      facet.lens = Facet::Lens::equisolid;
      facet.lens_factor = sin(quarter_fov);
      break;
    case image::Projection::fisheye_stereographic:
      facet.lens = Facet::Lens::stereographic;
      facet.lens_factor = tan(quarter_fov);
      break;
    default:
      facet.lens = Facet::Lens::equidistant;
      facet.lens_factor = quarter_fov.in(rad);
      break;
  }
  return facet;
}

Facet face_facet(const image::Camera& camera, image::CubeFace face) {
  Facet facet;
  const int n = image::cube_face_size(camera);
  const auto origin = image::cube_face_origin(camera, face);
  const auto axes = image::cube_face_axes(camera.cube_layout, face);
  facet.x0 = origin.x;
  facet.y0 = origin.y;
  facet.width = facet.height = n;
  facet.centre_x = origin.x + 0.5 * n;
  facet.centre_y = origin.y + 0.5 * n;
  facet.unit_px = 0.5 * n;
  facet.axes = camera.camera_to_enu * glm::dmat3(axes.right, axes.up, axes.forward);
  return facet;
}

}  // namespace

glm::dvec3 Facet::direction(double x, double y) const {
  const double r2 = x * x + y * y;
  if (lens == Lens::plane) return axes * (glm::dvec3(x, y, 1) / std::sqrt(1 + r2));
  if (lens == Lens::octahedral) return axes * image::octahedral_direction(x, -y);
  // s = sin(theta/2) / r and c = cos(theta/2); c^2 - (s r)^2 as a product keeps its digits near
  // 90 deg, where the zenith camera has its horizon.
  double s = lens_factor, c = 0;
  switch (lens) {
    case Lens::equisolid:
      c = std::sqrt(std::max(0.0, 1 - s * s * r2));
      break;
    case Lens::stereographic:
      c = 1 / std::sqrt(1 + s * s * r2);
      s *= c;
      break;
    default: {
      const double r = std::sqrt(r2), half = s * r;
      c = std::cos(half);
      if (half > 0) s = std::sin(half) / r;
    }
  }
  const double sr = s * std::sqrt(r2);
  return axes * glm::dvec3(2 * s * c * x, 2 * s * c * y, (c - sr) * (c + sr));
}

double Facet::largest_pixel_side() const {
  if (lens == Lens::octahedral) return std::sqrt(std::numbers::pi) / unit_px;
  // All other lenses here have their largest pixels on the axis; a pixel's mean cannot exceed that.
  return (lens == Lens::plane ? 1.0 : 2 * lens_factor) / unit_px;
}

PixelSpan Facet::visible(int row) const {
  PixelSpan span{x0, x0 + width};
  if (lens == Lens::plane || lens == Lens::octahedral) return span;
  // As image::direction_at: a pixel belongs to the picture if its centre is inside the circle.
  constexpr double kEdge = (1 + 1e-9) * (1 + 1e-9);
  const double y = y_of(row), rest = kEdge - y * y;
  if (rest < 0) return {x0, x0};
  const double half = unit_px * std::sqrt(rest);
  span.begin = std::clamp(static_cast<int>(centre_x - half - 0.5), x0, x0 + width);
  span.end = std::clamp(static_cast<int>(centre_x + half + 1.5), x0, x0 + width);
  auto inside = [&](int column) { return x_of(column) * x_of(column) <= rest; };
  while (span.begin < span.end && !inside(span.begin)) ++span.begin;
  while (span.begin < span.end && !inside(span.end - 1)) --span.end;
  return span;
}

std::vector<Facet> facets_of(const image::Camera& camera) {
  switch (camera.projection) {
    case image::Projection::cube: {
      std::vector<Facet> faces;
      for (const image::CubeFace face : image::kCubeFaces)
        faces.push_back(face_facet(camera, face));
      std::sort(faces.begin(), faces.end(),
                [](const Facet& a, const Facet& b) { return a.x0 < b.x0; });
      return faces;
    }
    case image::Projection::perspective: {
      Facet facet = whole_image(camera);
      facet.unit_px = image::perspective_focal_length_px(camera);
      return {facet};
    }
    case image::Projection::octahedral: {
      Facet facet = whole_image(camera);
      facet.lens = Facet::Lens::octahedral;
      facet.unit_px = 0.5 * camera.width;
      return {facet};
    }
    default:
      return {fisheye_facet(camera)};
  }
}

}  // namespace skylapse::sky
