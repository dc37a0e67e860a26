#include "image/camera/perspective.h"

#include "image/camera/planar.h"

namespace skylapse::image {

double perspective_focal_length_px(const Camera& camera) {
  return 0.5 * camera.width / tan(0.5 * camera.field_of_view);
}

Direction<CameraFrame> perspective_ray(const Camera& camera, PixelPosition position) {
  return Direction<CameraFrame>::from_vector({position.x - 0.5 * camera.width,
                                              0.5 * camera.height - position.y,
                                              perspective_focal_length_px(camera)});
}

std::optional<PixelPosition> perspective_position(const Camera& camera,
                                                  const Direction<CameraFrame>& direction) {
  if (!(direction.z() > 0)) return {};
  const double scale = perspective_focal_length_px(camera) / direction.z();
  return PixelPosition{0.5 * camera.width + scale * direction.x(),
                       0.5 * camera.height - scale * direction.y()};
}

double perspective_solid_angle_sr(const Camera& camera, int x, int y) {
  const double f = perspective_focal_length_px(camera);
  const double left = x - 0.5 * camera.width, top = y - 0.5 * camera.height;
  return solid_angle_sr({left / f, (left + 1) / f, top / f, (top + 1) / f});
}

}  // namespace skylapse::image
