#include "image/camera/lat_long.h"

namespace skylapse::image {
namespace {
constexpr double kPi = std::numbers::pi;
}

Direction<CameraFrame> lat_long_ray(const Camera& camera, PixelPosition position) {
  const double longitude = (position.x / camera.width - 0.5) * 2 * kPi;
  const double zenith = position.y / camera.height * kPi;
  const double s = std::sin(zenith);
  return Direction<CameraFrame>::from_vector(
      {s * std::sin(longitude), std::cos(zenith), s * std::cos(longitude)});
}

PixelPosition lat_long_position(const Camera& camera, const Direction<CameraFrame>& direction) {
  const double horizontal = std::hypot(direction.x(), direction.z());
  const double longitude = horizontal > 0 ? std::atan2(direction.x(), direction.z()) : 0;
  return {(longitude / (2 * kPi) + 0.5) * camera.width,
          std::atan2(horizontal, direction.y()) / kPi * camera.height};
}

double lat_long_solid_angle_sr(const Camera& camera, int y) {
  // cos(top) - cos(bottom) as a product: nothing cancels in the small rows at the poles.
  const double row = kPi / camera.height;
  return 2 * kPi / camera.width * 2 * std::sin((y + 0.5) * row) * std::sin(0.5 * row);
}

}  // namespace skylapse::image
