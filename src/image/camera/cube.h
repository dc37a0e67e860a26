#pragma once
// Cube maps: six perspective images of 90 degrees. Axes as OpenEXR: X = left (west when the
// heading is north), Y = up, Z = ahead.
#include <array>

#include "image/camera/camera.h"

namespace skylapse::image {

enum class CubeFace { pos_x, neg_x, pos_y, neg_y, pos_z, neg_z };
inline constexpr std::array kCubeFaces{CubeFace::pos_x, CubeFace::neg_x, CubeFace::pos_y,
                                       CubeFace::neg_y, CubeFace::pos_z, CubeFace::neg_z};

/// A face's axes in the camera frame (right, up, forward): unit vectors along the axes.
struct CubeFaceAxes {
  glm::dvec3 forward;  // to the middle of the face
  glm::dvec3 right;    // as its pixel columns grow
  glm::dvec3 up;       // against its pixel rows
};
CubeFaceAxes cube_face_axes(CubeLayout layout, CubeFace face);

/// Side of a face in pixels.
int cube_face_size(const Camera& camera);

/// Left and top pixel of a face in the image.
struct CubeFaceOrigin {
  int x, y;
};
CubeFaceOrigin cube_face_origin(const Camera& camera, CubeFace face);

/// The face that holds a position of the image; nothing on the blank parts of a cross.
std::optional<CubeFace> cube_face_at(const Camera& camera, PixelPosition position);

/// Direction of a position (in pixels of the image), on the plane of the given face; the plane
/// goes on beyond the face's edges.
Direction<CameraFrame> cube_ray(const Camera& camera, CubeFace face, PixelPosition position);

/// The face a direction meets, and where in the image. A direction on an edge belongs to one of
/// the faces that share it; the position is strictly on that face.
PixelPosition cube_position(const Camera& camera, const Direction<CameraFrame>& direction);

double cube_solid_angle_sr(const Camera& camera, CubeFace face, int x, int y);

}  // namespace skylapse::image
