#include "image/orientation.h"

#include <algorithm>

namespace skylapse::image {
namespace {

constexpr glm::dvec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};
/// Without the zeros of a minus sign.
constexpr glm::dvec3 against(const glm::dvec3& v) { return {0 - v.x, 0 - v.y, 0 - v.z}; }
constexpr Angle kNorth = 0 * deg, kEast = 90 * deg, kSouth = 180 * deg, kWest = 270 * deg;

/// OpenGL's lookup vector is left-handed. three.js and glTF viewers mirror theirs in x; the camera
/// heads for where its -z is, north (of Unity: south). Where a program has no cubes of its own, the
/// strip turns with the lat-long map.
constexpr std::array<OrientationConvention, 9> kConventions{{
    {Orientation::openexr, "openexr", against(kX), kZ, kY, kNorth, false, kNorth,
     CubeOrder::openexr},
    {Orientation::usd, "usd", kX, against(kZ), kY, kSouth, false, kSouth, CubeOrder::openexr},
    {Orientation::blender, "blender", kX, kY, kZ, kEast, false, kEast, CubeOrder::openexr},
    {Orientation::three, "three", kX, against(kZ), kY, kEast, false, kNorth, CubeOrder::opengl},
    {Orientation::gltf, "gltf", kX, against(kZ), kY, kEast, false, kNorth, CubeOrder::opengl},
    {Orientation::unreal, "unreal", kX, against(kY), kZ, kNorth, false, kNorth, CubeOrder::openexr},
    {Orientation::unity, "unity", kX, kZ, kY, kEast, false, kSouth, CubeOrder::opengl},
    {Orientation::pbrt, "pbrt", kX, kY, kZ, kWest, true, kWest, CubeOrder::openexr},
    {Orientation::mitsuba, "mitsuba", kX, against(kZ), kY, kSouth, false, kSouth,
     CubeOrder::openexr},
}};

}  // namespace

const OrientationConvention& convention_of(Orientation orientation) {
  return kConventions[static_cast<size_t>(orientation)];
}

std::string_view name_of(Orientation orientation) { return convention_of(orientation).name; }

std::optional<Orientation> orientation_from_name(std::string_view name) {
  const auto* const found = std::ranges::find(kConventions, name, &OrientationConvention::name);
  if (found == kConventions.end()) return std::nullopt;
  return found->orientation;
}

Angle lat_long_heading(Orientation orientation) {
  return convention_of(orientation).lat_long_heading;
}

Angle map_heading(Projection projection, Orientation orientation) {
  if (projection == Projection::lat_long) return convention_of(orientation).lat_long_heading;
  if (projection == Projection::cube) return convention_of(orientation).cube_heading;
  return kNorth;
}

glm::dmat3 enu_to_world(Orientation orientation) {
  const OrientationConvention& c = convention_of(orientation);
  return {c.east, c.north, c.up};
}

const std::array<CubeFace, 6>& faces_in(CubeOrder order) {
  static constexpr std::array<CubeFace, 6> kOpenGl{CubeFace::pos_x, CubeFace::neg_x,
                                                   CubeFace::pos_y, CubeFace::neg_y,
                                                   CubeFace::neg_z, CubeFace::pos_z};
  return order == CubeOrder::openexr ? kCubeFaces : kOpenGl;
}

}  // namespace skylapse::image
