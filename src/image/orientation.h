#pragma once
// How renderers lay the world into environment maps.
#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "core/quantity.h"
#include "image/camera/camera.h"
#include "image/camera/cube.h"

namespace skylapse::image {

/// A renderer's convention: which axes it has, which direction of its axes a lat-long map shows in
/// its centre, how its cubes are laid out, and where we put north in its world.
enum class Orientation { openexr, usd, blender, three, gltf, unreal, unity, pbrt, mitsuba };

inline constexpr std::array kOrientations{
    Orientation::openexr, Orientation::usd,  Orientation::blender,
    Orientation::three,   Orientation::gltf, Orientation::unreal,
    Orientation::unity,   Orientation::pbrt, Orientation::mitsuba};

/// The six images of a cube, in the order +X -X +Y -Y +Z -Z of the program's own names.
enum class CubeOrder {
  openexr,  // as ImfEnvmap.h: right-handed axes X Y Z
  /// As OpenGL, Vulkan, Direct3D and KTX 2 define them: left-handed axes, so that each image is a
  /// plain view from inside. The same images with the last two exchanged, about another heading.
  opengl,
};

/// One convention with where it is written down. Axes are the program's own world axes.
///
/// program   handed  north  east   centre of a lat-long map   source
/// openexr   right   +Z     -X     +Z north    OpenEXR, ImfEnvmap.h; docs/conventions.md
/// usd       right   -Z     +X     +Z south    UsdLux DomeLight: "adheres to the OpenEXR
///                                             specification for latitude-longitude maps"
/// blender   right   +Y     +X     +X east     Cycles, kernel/camera/projection.h,
///                                             direction_to_equirectangular
/// three     right   -Z     +X     +X east     three.js, ShaderChunk/common.glsl.js, equirectUv
/// gltf      right   -Z     +X     +X east     Khronos glTF, pull request 1761: "The center of the
///                                             image is where the +X axis points"
/// unreal    left    -Y     +X     -Y north    import of long-lat images to cubes: u =
///                                             (1 + atan2(x, -y) / pi) / 2, v = acos(z) / pi
/// unity     left    +Z     +X     +X east     built-in shader Skybox/Panoramic, ToRadialCoords
/// pbrt      right   +Y     +X     -X west,    pbrt-4, imgtool makeequiarea: u = phi / (2 pi)
///                                 mirrored    counter-clockwise about z
/// mitsuba   right   -Z     +X     +Z south    Mitsuba 3, emitters/envmap.cpp: u =
///                                             atan2(x, -z) / (2 pi), v = acos(y) / pi
///
/// Up is +Y where north is +-Z, else +Z. North and east are ours to choose, as none of the programs
/// knows a compass; they are chosen so that a plan seen from above has north at its top and east to
/// the right in the program's usual view. So do Houdini, Maya and three.js with -Z away from the
/// viewer; USD's own turn into a Z-up stage (orientToStageUpAxis) then gives X east, Y north. In
/// Unreal that is the frame of its GeoReferencing plugin (X east, Y south); OpenEXR has no world,
/// and keeps the axes that docs/conventions.md gives it.
/// pbrt itself is left-handed; scenes in right-handed coordinates begin with "Scale -1 1 1" before
/// the camera, and are what is meant here. It reads square equal-area octahedral maps alone.
struct OrientationConvention {
  Orientation orientation;
  std::string_view name;       // the word of the config
  glm::dvec3 east, north, up;  // in the program's axes
  Angle lat_long_heading;      // azimuth of the centre of a lat-long map
  bool lat_long_mirrored;      // east lies left of north
  Angle cube_heading;          // of the cube camera whose strip's faces the six images are
  CubeOrder cube_order;        // of six images in files of their own
};

const OrientationConvention& convention_of(Orientation orientation);

/// "openexr", "usd", "blender", "three", "gltf", "unreal", "unity", "pbrt", "mitsuba".
std::string_view name_of(Orientation orientation);
std::optional<Orientation> orientation_from_name(std::string_view name);

/// Heading that makes a lat-long camera's map right for the program. Of pbrt, which wants such a
/// map mirrored (lat_long_mirrored): before that.
Angle lat_long_heading(Orientation orientation);

/// Heading of the camera of a projection that sees the whole sphere: of lat-long maps, else of
/// cubes. An equal-area octahedral map is not turned: pbrt's x, y, z are east, north and up.
Angle map_heading(Projection projection, Orientation orientation);

/// A direction or vector in east-north-up to the program's axes: orthonormal, determinant +1 or, of
/// left-handed programs, -1.
glm::dmat3 enu_to_world(Orientation orientation);

/// Which faces of a strip of a cube camera (as ImfEnvmap.h) are the six images.
const std::array<CubeFace, 6>& faces_in(CubeOrder order);

}  // namespace skylapse::image
